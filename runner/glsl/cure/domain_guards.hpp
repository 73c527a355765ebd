// Proposes guards for operations that can be outside of their domain, from one table row per function. A
// guard passes an operand that is inside the domain unchanged, bit by bit.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// Returns the guards for a call or a quotient of floats, the simplest first. Empty if none is known or the
/// text cannot be changed there. The caller measures whether a guard helps.
std::vector<Cure> domain_guards(const ParsedText& text, const TreeFacts& facts, NodeId operation);

} // namespace tidemark::glsl
