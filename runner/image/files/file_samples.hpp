// Converts the samples of an Image to those of a file of a given depth. Uses neither files nor codecs.
#pragma once

#include "image/files/picture_file.hpp"
#include "image/image.hpp"

#include <cstddef>
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

/// Decodes an sRGB picture to linear light, in floats; alpha stays.
Image in_light(const Image& image);

/// Converts to floats and multiplies the colours by alpha, without clamping either.
Image premultiplied(const Image& image);

/// Converts to samples of Radiance HDR: three channels of f32, grey repeated, without alpha, negatives and
/// NaN as 0, and clamped to the format's largest number.
Image radiance_samples(const Image& image);

} // namespace tidemark::image
