// Blue noise of one channel: a mask in which similar values keep their distance.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace tidemark::image {

/// The side of the mask.
inline constexpr int k_blue_side = 128;

/// Returns a mask of k_blue_side² bytes, row by row, that tiles; each value 0..255 occurs 64 times. Void and
/// cluster (R. Ulichney, "The void-and-cluster method for dither array generation", 1993) with a Gaussian of
/// deviation 1.5 texels. The energies are integers, so the bytes are the same on every machine.
std::vector<uint8_t> make_blue_mask(std::mt19937& random);

} // namespace tidemark::image
