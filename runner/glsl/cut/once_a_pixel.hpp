// What is the same in the whole frame, and computed again in turns of loops and calls, as global variables
// that mainImage begins with. The most that a text can do: ShaderToy has no place that runs once a frame.
#pragma once

#include "glsl/cut/cuts.hpp"

#include <optional>

namespace tidemark::glsl {

/// All such expressions of mainImage's file in one cut; nothing where there are none. The language promises
/// the same values; a driver may round differently.
std::optional<Cut> once_a_pixel(const ParsedText& text, const TreeFacts& facts, const WorkEstimate& work);

} // namespace tidemark::glsl
