// Zeros for what a text reads before it has a value: what ShaderToy's site gives there.
#pragma once

#include "glsl/analysis/unassigned.hpp"
#include "glsl/cure/written.hpp"

namespace tidemark::glsl {

/// Nothing for an array of unknown length or many numbers, and where the words cannot be changed.
std::optional<Cure> initial_value(const ParsedText& text, const TreeFacts& facts, const Unassigned& fault);

} // namespace tidemark::glsl
