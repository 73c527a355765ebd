// A loop that counts in whole numbers, and has its float from them.
#pragma once

#include "glsl/cure/written.hpp"
#include "glsl/flow/float_counter.hpp"

namespace tidemark::glsl {

/// `for (int x_turn = 0; x_turn < 100; ++x_turn) { float x = 0.0 + 0.01 * float(x_turn); … }`: as many turns
/// as in real arithmetic, and no rounding added to another. Nothing where the words are not the author's own.
std::optional<Cure> whole_counter(const ParsedText& text, const FloatCounter& counter);

} // namespace tidemark::glsl
