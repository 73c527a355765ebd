// Converts pictures for encoders of 10 bits: planes of Y'CbCr by BT.709's matrix, in the limited range (ITU-R
// BT.709-6, 3.4 and 4.6: black is 64, white 940, no colour 512). Does not use ffmpeg's own conversion, which
// maps white to 944.
#pragma once

#include "image/image.hpp"

#include <cstdint>
#include <vector>

namespace tidemark::image {

/// Returns planes of Y', Cb, Cr and, with `alpha`, of alpha in the range 0 to 1023; each from the top row
/// down (ffmpeg's yuv444p10 and yuva444p10, in this machine's byte order). Colours and alpha are clamped to
/// 0..1, NaN to 0, and rounded to nearest: first to 16 bits, so that 16-bit pictures give the same video.
std::vector<uint16_t> ten_bit_planes(const Image& image, bool alpha);

} // namespace tidemark::image
