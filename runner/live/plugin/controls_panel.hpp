// The panel at the left: all that can be set.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

/// Changes the model as people change it, and says so.
void draw_controls(Model& model, const Surface& surface, Commands& commands);

} // namespace tidemark::live
