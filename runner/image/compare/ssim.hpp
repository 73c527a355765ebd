// Structural similarity: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment:
// from error visibility to structural similarity", IEEE Trans. Image Processing 13(4), 2004.
#pragma once

#include "image/image.hpp"

namespace tidemark::image {

/// The width of the window, which is the smallest side of a picture with an SSIM.
inline constexpr int k_ssim_window = 11;

/// Returns the mean SSIM over all window positions (Gaussian of deviation 1.5; K1 = 0.01, K2 = 0.03, peak 1)
/// and over red, green and blue as shown; 1 for equal pictures. Returns NaN for pictures smaller than the
/// window. Both must have the same size.
double ssim(const Image& left, const Image& right);

} // namespace tidemark::image
