// Fixes a texture look-up so that its mipmap level comes from the text, not from neighbouring pixels.
#pragma once

#include "glsl/analysis/divergence.hpp"
#include "glsl/cure/written.hpp"

namespace tidemark::glsl {

/// Returns the tokens of a call of `texture` with a named sampler, as its author wrote them; nothing for
/// anything else.
std::optional<WrittenTokens> look_up_by_neighbours(const ParsedText& text, const TreeFacts& facts, NodeId id);

/// Sets the base level and drops a bias: a bias of -100 would also choose the base level, but it stays
/// undefined.
std::optional<Cure> base_level(const ParsedText& text, const TreeFacts& facts, const Divergent& fault);

} // namespace tidemark::glsl
