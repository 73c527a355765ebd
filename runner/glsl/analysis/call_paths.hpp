// How the program can come to an operation: the calls and the loops on every way from main.
#pragma once

#include "glsl/syntax/tree_facts.hpp"

#include <vector>

namespace tidemark::glsl {

struct CallPaths {
    std::vector<NodeId> calls; ///< of functions that come to the operation; ascending
    std::vector<NodeId> loops; ///< around the operation or around such a call
};

CallPaths find_call_paths(const ParsedText& text, const TreeFacts& facts, NodeId operation);

} // namespace tidemark::glsl
