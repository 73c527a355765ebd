// The pictures that passes draw and read: thumbnails to choose from, and one large picture.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

void draw_thumbnails(const Model& model, const Surface& surface, Commands& commands);
/// Draws a picture below all panels, as large as the window allows.
void draw_large(const PictureField& picture, const Surface& surface);

} // namespace tidemark::live
