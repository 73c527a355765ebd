// The pictures that passes draw and read: small ones to choose from, and one large.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

void draw_thumbnails(const Model& model, const Surface& surface, Commands& commands);
/// Behind all panels, as large as the window allows.
void draw_large(const PictureField& picture, const Surface& surface);

} // namespace tidemark::live
