// The panel next to the pointer: the surrounding pixels, enlarged, and the values that passes wrote into the
// one under it.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

void draw_magnifier(const MagnifierField& magnifier, const Surface& surface);

} // namespace tidemark::live
