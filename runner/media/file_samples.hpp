// Converts the samples of an Image to those of a file of a given depth. Uses neither files nor codecs.
#pragma once

#include "media/image.hpp"
#include "media/picture_file.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tidemark::image {

/// Returns all samples in the type of `depth` (half: as f32, which the codec narrows), rows from the bottom.
/// u8 to a wider type is exactly v/255 (u16: 257 v); f32 to u8 and u16 clamps to 0..1, converts NaN to 0 and
/// rounds to nearest; f32 to f32 keeps every bit.
std::vector<std::byte> file_samples(const Image& image, SampleDepth depth);

/// Converts a picture to bytes, like `file_samples`.
Image in_bytes(Image image);

/// Converts a picture to floats, bytes as v/255.
Image in_floats(Image image);

/// Returns the picture with as many channels (1 grey, 2 with alpha, 3 colour, 4 with alpha): grey is repeated
/// as red, green and blue, and a missing alpha is 1. It must have no colour or alpha that would be lost.
Image with_channels(const Image& image, int channels);

/// Decodes an sRGB picture to linear light, in floats; alpha stays.
Image in_light(const Image& image);

/// Converts to floats and multiplies the colours by alpha, without clamping either.
Image premultiplied(const Image& image);

/// Converts to samples of Radiance HDR: three channels of f32, grey repeated, without alpha, negatives and
/// NaN as 0, and clamped to the format's largest number.
Image radiance_samples(const Image& image);

// Converts pictures for encoders of 10 bits: planes of Y'CbCr by BT.709's matrix, in the limited range (ITU-R
// BT.709-6, 3.4 and 4.6: black is 64, white 940, no colour 512). Does not use ffmpeg's own conversion, which
// maps white to 944.

/// Returns planes of Y', Cb, Cr and, with `alpha`, of alpha in the range 0 to 1023; each from the top row
/// down (ffmpeg's yuv444p10 and yuva444p10, in this machine's byte order). Colours and alpha are clamped to
/// 0..1, NaN to 0, and rounded to nearest: first to 16 bits, so that 16-bit pictures give the same video.
std::vector<uint16_t> ten_bit_planes(const Image& image, bool alpha);

} // namespace tidemark::image
