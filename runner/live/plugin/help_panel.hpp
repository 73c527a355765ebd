// The panel in the middle: what keys and mouse do.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

void draw_help(const Model& model, const Surface& surface);

} // namespace tidemark::live
