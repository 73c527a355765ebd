// Guards for operations that are outside of their domain somewhere: what a text could say instead, one row
// for each function. A guard hands on an operand that is inside of the domain as it is, bit by bit.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// The guards for a call or a quotient of floats, the plainest first; empty: none is known, or its words
/// cannot be changed where they stand. Whether one helps is for who draws it to say.
std::vector<Cure> domain_guards(const ParsedText& text, const TreeFacts& facts, NodeId operation);

} // namespace tidemark::glsl
