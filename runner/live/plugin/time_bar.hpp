// The bar at the bottom: time, and the cost of a frame.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

/// Draws the bar and returns its height in pixels.
float draw_time_bar(Model& model, const Surface& surface, Commands& commands);

} // namespace tidemark::live
