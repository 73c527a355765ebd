// Bounds the values of a pass over all pixels of a frame and a time span at once.
#pragma once

#include "ir/value_ranges.hpp"
#include "lab/march/march_rays.hpp"

namespace tidemark::lab {

/// The time runs from 0 to `seconds`; each knob takes its whole range; the mouse is that of the drawn frame.
/// Other passes' pictures may be any finite number; keys, sound and videos are from 0 to 1.
ir::ValueRanges ranges_of(const DrawnPass& drawn, double seconds);

} // namespace tidemark::lab
