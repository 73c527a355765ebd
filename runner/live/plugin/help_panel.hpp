// The panel in the middle, with the effects of keys and mouse.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

void draw_help(const Model& model, const Surface& surface);

} // namespace tidemark::live
