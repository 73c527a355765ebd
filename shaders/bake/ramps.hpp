// Generates the small pictures in which shaders/pseudo3d_water.glsl looks up its colours and
// shaders/stylized_waves.glsl its waves. The bytes are the same on every machine. Writes no file.
#pragma once

#include "media/image.hpp"

#include <string>
#include <vector>

namespace tidemark::bake {

/// A picture and its name in textures/, without the extension.
struct NamedImage {
    std::string name;
    image::Image image;
};

/// Returns the pictures:
///
/// "water_ramp" (colour of the water) and "foam_ramp" (colour of the foam, alpha its cover): RGBA, 8 bit,
/// straight alpha, encoded for display. The horizontal axis is the lightness of the noise, 0 at the left edge
/// to 1 at the right; the vertical axis is the distance, 0 (at the viewer's feet) at the bottom edge to 1
/// (the horizon) at the top.
///
/// "wave_ramps": RGBA, f32 (16 bits are enough in a file), one row of 256: four ramps over a wave's phase, 0
/// at the left edge to 1 at the right; they are periodic. A wave runs towards higher phases; at a fixed place
/// the phase falls. Red: the water's height, 0..1, steep ahead of the crest. Green, blue, alpha: cover of the
/// foam on the wave's front, in the tail that follows the crest, and of the water that then rolls back down
/// the shore.
std::vector<NamedImage> make_ramps();

} // namespace tidemark::bake
