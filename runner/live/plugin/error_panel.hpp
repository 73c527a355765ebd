// The panel at the bottom: what is wrong with the scene.
#pragma once

#include "live/plugin/panels.hpp"

struct ImFont;

namespace tidemark::live {

struct ErrorLayout {
    ImFont* large;    ///< for what is wrong first
    float bottom = 0; ///< pixels below that are something else's
};

void draw_errors(const Model& model, const Surface& surface, const ErrorLayout& layout, Commands& commands);

} // namespace tidemark::live
