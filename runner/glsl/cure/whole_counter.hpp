// Fixes a loop with a float counter by counting in whole numbers and computing the float from them.
#pragma once

#include "glsl/cure/written.hpp"
#include "glsl/flow/float_counter.hpp"

namespace tidemark::glsl {

/// Writes `for (int x_turn = 0; x_turn < 100; ++x_turn) { float x = 0.0 + 0.01 * float(x_turn); … }`: as many
/// iterations as in real arithmetic, and no accumulated rounding. Returns nothing if the text is not the
/// author's own.
std::optional<Cure> whole_counter(const ParsedText& text, const FloatCounter& counter);

} // namespace tidemark::glsl
