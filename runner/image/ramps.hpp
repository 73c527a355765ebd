// The small pictures that shaders/pseudo3d_water.glsl looks its colours up in, made from nothing. The bytes
// are the same on every machine. Writes no file.
#pragma once

#include "image/image.hpp"

#include <string>
#include <vector>

namespace tidemark::image {

/// A picture and the name it goes by in textures/, without the ending.
struct NamedImage {
    std::string name;
    Image image;
};

/// "water_ramp" (colour of the water) and "foam_ramp" (colour of the foam, alpha its cover): RGBA, 8 bit,
/// straight alpha, encoded for display. Across stands the lightness of the noise, 0 at the left edge to 1 at
/// the right; up stands the distance, 0 (at the viewer's feet) at the bottom edge to 1 (the horizon) at the
/// top.
std::vector<NamedImage> make_ramps();

} // namespace tidemark::image
