// The bar at the bottom: time, and what the frame costs.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

/// Gives its height in pixels.
float draw_time_bar(Model& model, const Surface& surface, Commands& commands);

} // namespace tidemark::live
