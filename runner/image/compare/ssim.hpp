// Structural similarity: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment:
// from error visibility to structural similarity", IEEE Trans. Image Processing 13(4), 2004.
#pragma once

#include "image/image.hpp"

namespace tidemark::image {

/// The smallest side of a picture that has one: the width of the window.
inline constexpr int k_ssim_window = 11;

/// The mean over all places of the window (Gaussian of deviation 1.5; K1 = 0.01, K2 = 0.03, peak 1) and over
/// red, green and blue as they are shown; 1 for equal pictures. NaN for pictures smaller than the window.
/// Both pictures have the same size.
double ssim(const Image& left, const Image& right);

} // namespace tidemark::image
