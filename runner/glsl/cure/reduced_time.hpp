// Phases that go on with the time, taken as fractions of a turn before they are added to anything: `sin(x
// + 50.0 * iTime)` has lost its digits after an hour, because a float holds 50 iTime to its own size.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// Of sines, cosines, `fract` and `mod` by a number, whose arguments have iTime times a number as a term: one
/// cure for each file, with a function that takes the product apart into exact ones and adds what iTime, a
/// float, leaves of the seconds (iTimeLow; 0 on other hosts).
std::vector<Cure> reduced_times(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
