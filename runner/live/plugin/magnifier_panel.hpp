// The panel beside the pointer: the pixels around it, large, and what passes wrote into the one under it.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

void draw_magnifier(const MagnifierField& magnifier, const Surface& surface);

} // namespace tidemark::live
