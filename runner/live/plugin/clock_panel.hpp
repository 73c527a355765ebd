// The panel in the upper right corner: how long the current frame has taken, and its progress. Takes no
// events.
#pragma once

#include "live/plugin/panels.hpp"

#include <string>

namespace tidemark::live {

void draw_clock(const std::string& text, const Surface& surface);

} // namespace tidemark::live
