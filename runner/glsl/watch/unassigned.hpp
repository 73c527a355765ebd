// Variables that are read although nothing gave them a value, on any way that leads to the read, and `out`
// parameters that never get one: undefined, but where a site or a driver happens to begin with zeros.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <vector>

namespace tidemark::glsl {

struct Unassigned {
    NodeId variable = k_no_node; ///< declarator or parameter
    NodeId read = k_no_node;     ///< the first; none: an `out` parameter that its function never writes
};

/// In functions that `main` comes to, in the order of the text. What may have a value on some way is left
/// out.
std::vector<Unassigned> find_unassigned(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
