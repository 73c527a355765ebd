// The panel at the left, with everything that can be set.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

/// Draws the panel. Applies edits to the model and adds a command for each.
void draw_controls(Model& model, const Surface& surface, Commands& commands);

} // namespace tidemark::live
