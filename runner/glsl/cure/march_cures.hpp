// For marches that pass over what they should hit, or end in front of it: shorter steps, and more of them.
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
std::vector<Cure> shorter_steps(const ParsedText& text, MarchPlace place);

} // namespace tidemark::glsl
