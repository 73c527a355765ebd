// Moves expressions that have one value for the whole frame out of loops and calls into global variables that
// mainImage computes first. A text can do no better: ShaderToy has no place that runs once per frame.
#pragma once

#include "glsl/cut/cuts.hpp"

#include <optional>

namespace tidemark::glsl {

/// Returns one cut with all such expressions of mainImage's file, or nothing if there are none. The language
/// guarantees the same values; a driver may round differently.
std::optional<Cut> once_a_pixel(const ParsedText& text, const TreeFacts& facts, const WorkEstimate& work);

} // namespace tidemark::glsl
