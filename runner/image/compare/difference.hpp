// Pictures of where and how much two pictures differ.
#pragma once

#include "image/image.hpp"
#include "image/plane.hpp"

namespace tidemark::image {

/// 0..1 as a colour that grows brighter throughout: black, blue, red, orange, pale yellow. Beyond: the end's.
std::array<float, 3> heat(double value);

/// A plane of 0..1 as a picture in those colours; NaN is magenta.
Image heat_map(const Plane& plane);

/// |left - right| times `gain`, sample by sample, without alpha. A pixel that has a NaN or infinity in one
/// picture, or another one in each, is magenta. Both have the same size and number of channels.
Image difference_picture(const Image& left, const Image& right, double gain);

} // namespace tidemark::image
