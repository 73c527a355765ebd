// Finds every path of calls from main to an operation, and the loops along those paths.
#pragma once

#include "glsl/syntax/tree_facts.hpp"

#include <vector>

namespace tidemark::glsl {

struct CallPaths {
    std::vector<NodeId> calls; ///< calls of functions that lead to the operation, ascending; functions that
                               ///< return arrays are left out
    std::vector<NodeId> loops; ///< loops around the operation or around one of those calls
};

CallPaths find_call_paths(const ParsedText& text, const TreeFacts& facts, NodeId operation);

} // namespace tidemark::glsl
