// The RGBA noise texture that ShaderToy's value noises are written for.
#pragma once

#include "image/image.hpp"

#include <cstdint>

namespace tidemark::image {

inline constexpr int k_noise_side = 256;
inline constexpr uint32_t k_noise_seed = 20130205;

/// 256x256 RGBA8 of uniform bytes. In the row order of a *file* (y from the top), with wrap and for every
/// texel, R(x,y) = G(x+37, y+17) and B(x,y) = A(x+37, y+17), as in ShaderToy's "RGBA Noise Medium": one
/// look-up of `.yx` gives two layers of a 3-D noise. G and A are independent. The same seed gives the same
/// bytes on every machine.
Image make_noise(uint32_t seed = k_noise_seed);

} // namespace tidemark::image
