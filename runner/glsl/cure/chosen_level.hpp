// A look-up in a texture that takes the level of its mipmaps from the text, not from neighbouring pixels.
#pragma once

#include "glsl/analysis/divergence.hpp"
#include "glsl/cure/written.hpp"

namespace tidemark::glsl {

/// A call of `texture` with a sampler by its name, in its author's words; nothing where it is no such call.
std::optional<WrittenTokens> look_up_by_neighbours(const ParsedText& text, const TreeFacts& facts, NodeId id);

/// The base level. A bias goes: one of -100 means the same, and is no less undefined.
std::optional<Cure> base_level(const ParsedText& text, const TreeFacts& facts, const Divergent& fault);

} // namespace tidemark::glsl
