// For marches that pass over what they should hit, or end in front of it: shorter steps, more of them, or a
// threshold that they can come to.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// Where a marching loop stands in its author's text.
struct MarchPlace {
    SourceLocation test;                 ///< of the comparison that looks at the distance
    std::vector<SourceLocation> updates; ///< where the place on the ray goes on
};

/// Twice as many turns, four times, eight times; empty where no number in the loop's head says how many.
std::vector<Cure> more_turns(const ParsedText& text, MarchPlace place);

/// Steps of 0.8, 0.6 and so on of what they were, with as many more turns where a number says how many; empty
/// where it is not certain what the step is.
std::vector<Cure> shorter_steps(const ParsedText& text, const MarchPlace& place);

/// A threshold of 4, 16, 64 and 256 times what the distance is compared with; empty where that is not a small
/// number, by its digits or by the name of a constant.
std::vector<Cure> larger_threshold(const ParsedText& text, const TreeFacts& facts, const MarchPlace& place);

} // namespace tidemark::glsl
