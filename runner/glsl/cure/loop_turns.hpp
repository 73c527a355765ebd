// Another number of turns for a loop whose text says one.
#pragma once

#include "glsl/cure/written.hpp"
#include "glsl/flow/loop_bound.hpp"

#include <optional>

namespace tidemark::glsl {

/// The number that `bound` counts to, so that the loop turns `turns` times. Nothing where there is none, or
/// where it cannot be written.
std::optional<Wrap> with_turns(const ParsedText& text, const LoopBound& bound, double turns);

} // namespace tidemark::glsl
