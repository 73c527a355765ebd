// Fixes a derivative, or a look-up that chooses its mipmap, by moving it before the place where pixels
// diverge.
#pragma once

#include "glsl/analysis/divergence.hpp"
#include "glsl/cure/written.hpp"

namespace tidemark::glsl {

/// Stores its value in a variable before the body's statement in which neighbouring pixels diverge. Returns
/// nothing if the function is called where they already diverge, if a name in the expression is declared or
/// set in between, or if its type is unknown.
std::optional<Cure> hoisted_derivative(const ParsedText& text, const TreeFacts& facts,
                                       const Divergent& fault);

} // namespace tidemark::glsl
