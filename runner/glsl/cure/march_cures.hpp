// Fixes marches that step over a surface or end before it: shorter steps, more of them, or a threshold that
// they can reach.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// The place of a marching loop in its author's text.
struct MarchPlace {
    SourceLocation test;                 ///< the comparison that tests the distance
    std::vector<SourceLocation> updates; ///< the assignments that advance the position on the ray
};

/// Returns fixes with 2, 4 and 8 times the iterations; empty if the loop's head has no literal bound.
std::vector<Cure> more_turns(const ParsedText& text, MarchPlace place);

/// Returns fixes with steps of 0.8, 0.6, 0.4, 0.25 and 0.1 of the distance, with as many more iterations
/// where the bound is a literal; empty if the step is not certain.
std::vector<Cure> shorter_steps(const ParsedText& text, const MarchPlace& place);

/// Returns fixes with 4, 16, 64 and 256 times the threshold, up to 0.1; empty if the threshold is not a small
/// literal or a constant with such a value.
std::vector<Cure> larger_threshold(const ParsedText& text, const TreeFacts& facts, const MarchPlace& place);

} // namespace tidemark::glsl
