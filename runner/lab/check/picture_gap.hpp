// Measures of the difference between two pictures, by the value that 99 % of the pixels stay below. They
// define when probes call two pictures the same.
#pragma once

#include "image/image.hpp"

#include <string>

namespace tidemark::lab {

/// Two pictures look the same if 99 % of their pixels differ by no more than this: one step of 8 bits.
inline constexpr double k_visible_gap = 1.0 / 255;

/// Returns the 99th percentile, over the pixels, of each pixel's largest sample difference. A sample that is
/// NaN or infinite in one picture only counts as 1. Pictures of floats, of one size.
double p99_difference(const image::Image& left, const image::Image& right);

/// Returns the percentage of the pixels that differ by more than k_visible_gap, counted in the same way.
double visibly_different_percent(const image::Image& left, const image::Image& right);

/// Returns the PSNR, such as `35.1 dB`, of two float pictures of one size. If pixels hold a NaN or an
/// infinity in only one picture, or different ones in both, the text counts them and gives the PSNR of the
/// other pixels.
std::string alikeness(const image::Image& before, const image::Image& after);

/// Returns the number of pixels whose bytes differ; both pictures have the same size and format.
size_t different_pixels(const image::Image& left, const image::Image& right);

} // namespace tidemark::lab
