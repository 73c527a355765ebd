// LDR-FLIP: the perceived difference of two pictures when flipping between them. P. Andersson, J. Nilsson, T.
// Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020.
#pragma once

#include "image/image.hpp"
#include "image/plane.hpp"

namespace tidemark::image {

/// The paper's viewer: a display 0.7 m and 3840 pixels wide, 0.7 m away.
inline constexpr double k_pixels_per_degree = 0.7 * 3840 / 0.7 * 3.14159265358979323846 / 180.0;

struct Flip {
    Plane map;         ///< 0 (same) to 1 for each pixel
    double mean = 0.0; ///< the main result in the paper
    double largest = 0.0;
};

/// Compares two pictures as sRGB, clamped to 0..1. Both must have the same size.
Flip flip(const Image& reference, const Image& test, double pixels_per_degree = k_pixels_per_degree);

} // namespace tidemark::image
