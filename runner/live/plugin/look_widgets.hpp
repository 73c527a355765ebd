// Fields below the thumbnails: how the large picture is viewed.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

/// Draws nothing if no picture is large.
void draw_look(const Model& model, Commands& commands);

} // namespace tidemark::live
