// Fixes reads of variables without a value by writing the zeros that ShaderToy's site uses.
#pragma once

#include "glsl/analysis/unassigned.hpp"
#include "glsl/cure/written.hpp"

namespace tidemark::glsl {

/// Returns nothing for an array of unknown length or many numbers, and where the text cannot be changed.
std::optional<Cure> initial_value(const ParsedText& text, const TreeFacts& facts, const Unassigned& fault);

} // namespace tidemark::glsl
