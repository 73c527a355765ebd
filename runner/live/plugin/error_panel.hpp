// The panel at the bottom, with the errors of the scene.
#pragma once

#include "live/plugin/panels.hpp"

struct ImFont;

namespace tidemark::live {

struct ErrorLayout {
    ImFont* large;    ///< for the first error
    float bottom = 0; ///< pixels at the bottom edge that the time bar takes
};

void draw_errors(const Model& model, const Surface& surface, const ErrorLayout& layout, Commands& commands);

} // namespace tidemark::live
