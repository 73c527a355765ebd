// A picture as encoders of more than 8 bits take it: planes of Y'CbCr by BT.709's matrix, 10 bits a sample in
// the limited range (ITU-R BT.709-6, 3.4 and 4.6: black is 64, white 940, no colour 512). No file, no
// process: ffmpeg's own conversion makes 944 of white.
#pragma once

#include "image/image.hpp"

#include <cstddef>
#include <vector>

namespace tidemark::image {

/// Planes of Y', Cb, Cr and, with `alpha`, of alpha, which has all of 0 to 1023; each from the top row down,
/// little-endian, 16 bits for each sample (ffmpeg's yuv444p10le and yuva444p10le). Colours and alpha are
/// taken to 0 to 1, NaN to 0, and rounded to nearest, once.
std::vector<std::byte> ten_bit_planes(const Image& image, bool alpha);

} // namespace tidemark::image
