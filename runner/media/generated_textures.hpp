// Makes noise textures and volumes with the size, channels and inner structure of those on ShaderToy. The
// same seed gives the same bytes on every machine.
#pragma once

#include "media/image.hpp"
#include "media/texture_files.hpp"

#include <cstdint>
#include <string_view>

namespace tidemark::image {

inline constexpr int k_noise_side = 256;
inline constexpr uint32_t k_noise_seed = 20130205;

/// Returns 256x256 RGBA8 of uniform bytes. In the row order of a *file* (y from the top), with wrap and for
/// every texel, R(x,y) = G(x+37, y+17) and B(x,y) = A(x+37, y+17), as in ShaderToy's "RGBA Noise Medium": one
/// look-up of `.yx` gives two layers of a 3-D noise. G and A are independent.
Image make_noise(uint32_t seed = k_noise_seed);

/// ShaderToy's RGBA Noise Medium and Small, Gray Noise Medium and Small, Blue Noise, Bayer.
enum class NoiseTexture { rgba_256, rgba_64, grey_256, grey_64, blue_1024, bayer_8 };

/// Returns a texture of 8 bits per sample that tiles seamlessly:
/// * rgba_256: `make_noise(seed)`.
/// * rgba_64: uniform bytes; in file order A(x,y) = B(x+1,y), where the end of a row continues at the start
///   of the row below, and the last texel at the first. R, G and B are independent.
/// * grey_256, grey_64: one channel of uniform bytes.
/// * blue_1024: 1024x1024 RGBA, four independent masks of 128x128 texels, repeated, in which all byte values
///   are equally frequent and similar values keep their distance (void and cluster, Ulichney 1993).
/// * bayer_8: 8x8, one channel, the recursive order 0 32 8 40 … in file order, as floor((order + 1/2) * 4):
///   the midpoints of the levels. The seed has no effect.
Image make_noise(NoiseTexture kind, uint32_t seed = k_noise_seed);

/// ShaderToy's Grey Noise 3D and RGBA Noise 3D.
enum class NoiseVolume { grey_32, rgba_32 };

/// Returns a volume of 32x32x32 texels of uniform bytes. The first 32768 bytes of rgba_32 are those of
/// grey_32 of the same seed.
VolumeData make_noise_volume(NoiseVolume kind, uint32_t seed = k_noise_seed);

// Makes a placeholder for a missing picture, cube or volume: a cloudy texture in a few colours with values of
// the middle range. The same name gives the same bytes.

/// Makes a picture of u8 samples, 1 to 4 channels (of 2 and 4 the last is alpha, 255). Pictures and volumes
/// tile seamlessly.
Image make_stand_in_picture(std::string_view name, Extent size, int channels);

/// Makes a placeholder for a camera's picture.
Image make_stand_in_camera();

/// Makes a cube without seams between the faces.
CubeFaces make_stand_in_cube(std::string_view name, int side, int channels);

VolumeData make_stand_in_volume(std::string_view name, int width, int height, int depth, int channels);

} // namespace tidemark::image
