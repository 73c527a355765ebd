// From the samples of an Image to the samples that a file of a given depth holds. No file, no codec.
#pragma once

#include "image/files/picture_file.hpp"
#include "image/image.hpp"

#include <cstddef>
#include <vector>

namespace tidemark::image {

/// All samples of the picture in the type of `depth` (half: as f32, which the codec narrows), rows from the
/// bottom. u8 to wider is v/255 exactly (u16: 257 v); f32 to u8 and u16 clamps to 0..1, makes NaN 0 and
/// rounds to nearest; f32 to f32 keeps every bit.
std::vector<std::byte> file_samples(const Image& image, SampleDepth depth);

/// The same picture in bytes, as `file_samples` makes them.
Image in_bytes(Image image);

/// The same picture in floats: bytes as v/255.
Image in_floats(Image image);

/// The light that the samples of an sRGB picture stand for, in floats; alpha is none and stays.
Image in_light(const Image& image);

/// In floats, the colours multiplied by alpha, whatever both are.
Image premultiplied(const Image& image);

/// What Radiance HDR can hold: three channels of f32, grey repeated, alpha left out, negatives and NaN as 0,
/// nothing above the format's largest number.
Image radiance_samples(const Image& image);

} // namespace tidemark::image
