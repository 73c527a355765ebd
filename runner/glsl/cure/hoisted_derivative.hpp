// A derivative, or a look-up that chooses its mipmap, taken before neighbouring pixels diverge.
#pragma once

#include "glsl/analysis/divergence.hpp"
#include "glsl/cure/written.hpp"

namespace tidemark::glsl {

/// Its value gets a name in front of the statement of the function's body in which neighbours diverge.
/// Nothing where it is called from a place where they already diverge, where something that it is made of is
/// declared or set in between, or where its type is not known.
std::optional<Cure> hoisted_derivative(const ParsedText& text, const TreeFacts& facts,
                                       const Divergent& fault);

} // namespace tidemark::glsl
