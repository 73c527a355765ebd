// How far two pictures are apart where nearly all pixels count: what "shows the same" means to the probes.
#pragma once

#include "image/image.hpp"

namespace tidemark::lab {

/// Two pictures show the same when 99 % of their pixels differ by no more: a step of 8 bits.
inline constexpr double k_visible_gap = 1.0 / 255;

/// Of the largest difference of a sample of each pixel, that which 99 % of the pixels stay below. What is a
/// number in one picture only counts as 1. Floats, of one size.
double p99_difference(const image::Image& left, const image::Image& right);

/// Pixels whose bytes differ, of two pictures of one size and kind.
size_t different_pixels(const image::Image& left, const image::Image& right);

} // namespace tidemark::lab
