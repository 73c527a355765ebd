// A picture as encoders of more than 8 bits take it: planes of Y'CbCr by BT.709's matrix, 10 bits a sample in
// the limited range (ITU-R BT.709-6, 3.4 and 4.6: black is 64, white 940, no colour 512). No file, no
// process: ffmpeg's own conversion makes 944 of white.
#pragma once

#include "image/image.hpp"

#include <cstdint>
#include <vector>

namespace tidemark::image {

/// Planes of Y', Cb, Cr and, with `alpha`, of alpha, which has all of 0 to 1023; each from the top row down
/// (ffmpeg's yuv444p10 and yuva444p10, in this machine's order of bytes). Colours and alpha are
/// taken to 0 to 1, NaN to 0, and rounded to nearest: first to 16 bits, so that pictures of 16 bits make the
/// very same video.
std::vector<uint16_t> ten_bit_planes(const Image& image, bool alpha);

} // namespace tidemark::image
