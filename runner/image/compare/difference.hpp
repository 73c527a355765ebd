// Makes pictures that show where and how much two pictures differ.
#pragma once

#include "image/image.hpp"
#include "image/plane.hpp"

namespace tidemark::image {

/// Maps 0..1 to a colour of rising brightness: black, blue, red, orange, pale yellow. Clamps other values.
std::array<float, 3> heat(double value);

/// Draws a plane of 0..1 in the colours of `heat`; NaN is magenta.
Image heat_map(const Plane& plane);

/// Returns |left - right| times `gain`, sample by sample, without alpha. Pixels with a NaN or infinity that
/// is not the same in both pictures are magenta. Both must have the same size and number of channels.
Image difference_picture(const Image& left, const Image& right, double gain);

} // namespace tidemark::image
