// Fixes phases that grow with the time by reducing them to fractions of a turn before anything is added:
// `sin(x + 50.0 * iTime)` has lost its digits after an hour, because a float's spacing grows with its size.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// Covers sines, cosines, `fract` and `mod` by a number whose arguments have iTime times a number as a term.
/// Returns one fix per file, with a function that splits the product into exact ones and adds the part of the
/// time that the float iTime cannot hold (iTimeLow, in seconds; 0 on other hosts).
std::vector<Cure> reduced_times(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
