// The small pictures that shaders/pseudo3d_water.glsl looks its colours up in, and
// shaders/stylized_waves.glsl its waves, made from nothing. The bytes are the same on every machine. Writes
// no file.
#pragma once

#include "image/image.hpp"

#include <string>
#include <vector>

namespace tidemark::bake {

/// A picture and the name it goes by in textures/, without the ending.
struct NamedImage {
    std::string name;
    image::Image image;
};

/// "water_ramp" (colour of the water) and "foam_ramp" (colour of the foam, alpha its cover): RGBA, 8 bit,
/// straight alpha, encoded for display. Across stands the lightness of the noise, 0 at the left edge to 1 at
/// the right; up stands the distance, 0 (at the viewer's feet) at the bottom edge to 1 (the horizon) at the
/// top.
///
/// "wave_ramps": RGBA, f32 (16 bits are enough in a file), one row of 256: four ramps over a wave's phase, 0
/// at the left edge to 1 at the right, that go on from 1 at 0. A wave runs towards higher phases; at one
/// place the phase falls. Red: the water's height, 0..1, steep ahead of the crest. Green, blue, alpha: cover
/// of the foam on the wave's front, in its tail behind the crest, and of what rolls back down the shore after
/// it.
std::vector<NamedImage> make_ramps();

} // namespace tidemark::bake
