// In the upper right corner: for how long a frame is being drawn, and how far it is. No event is its own.
#pragma once

#include "live/plugin/panels.hpp"

#include <string>

namespace tidemark::live {

void draw_clock(const std::string& text, const Surface& surface);

} // namespace tidemark::live
