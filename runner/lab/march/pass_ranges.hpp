// What a pass computes, bounded over all pixels of a frame and a span of time at once.
#pragma once

#include "ir/value_ranges.hpp"
#include "lab/march/march_rays.hpp"

namespace tidemark::lab {

/// From 0 to `seconds`, with each knob anywhere in its range, and the mouse as the drawn frame has it. What
/// other passes drew is any number; keys, sound and videos are from 0 to 1.
ir::ValueRanges ranges_of(const DrawnPass& drawn, double seconds);

} // namespace tidemark::lab
