// How far two pictures are apart where nearly all pixels count: what "shows the same" means to the probes.
#pragma once

#include "image/image.hpp"

#include <string>

namespace tidemark::lab {

/// Two pictures show the same when 99 % of their pixels differ by no more: a step of 8 bits.
inline constexpr double k_visible_gap = 1.0 / 255;

/// Of the largest difference of a sample of each pixel, that which 99 % of the pixels stay below. What is a
/// number in one picture only counts as 1. Floats, of one size.
double p99_difference(const image::Image& left, const image::Image& right);

/// Percent of the pixels that differ by more than k_visible_gap, counted in the same way.
double visibly_different_percent(const image::Image& left, const image::Image& right);

/// `35.1 dB`: the PSNR of a picture and the one it became, floats, of one size. Pixels that hold a NaN or an
/// infinity in one of them only, or another one in each, have no place in that number: they are counted, and
/// it is that of the pixels without any.
std::string alikeness(const image::Image& before, const image::Image& after);

/// Pixels whose bytes differ, of two pictures of one size and kind.
size_t different_pixels(const image::Image& left, const image::Image& right);

} // namespace tidemark::lab
