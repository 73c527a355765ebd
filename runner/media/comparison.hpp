// Comparing pictures: SSIM, FLIP, difference pictures, error measures.
//
// Planes of one number per pixel, and filters for them, as perceptual metrics use them. Independent of files
// and colour.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "media/image.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace tidemark::image {

/// Rows run from the bottom, as in an Image.
struct Plane {
    Extent extent;
    std::vector<double> values;

    explicit Plane(Extent size = {}, double value = 0.0) : extent(size), values(size.pixels(), value) {}
    double at(int x, int y) const { return values[size_t(y) * size_t(extent.width) + size_t(x)]; }
};

/// Weights for the offsets -radius..radius; their number is odd.
using Kernel = std::vector<double>;

/// Returns exp(-x² / (2 deviation²)) for the offsets -radius..radius, not normalised.
Kernel gaussian(double deviation, int radius);

/// Convolves by `row` along x, then by `column` along y. Pixels beyond an edge equal those at the edge.
Plane convolved(const Plane& plane, const Kernel& row, const Kernel& column);

/// Returns a channel of a picture: bytes as v / 255, floats unchanged.
Plane channel_of(const Image& image, int channel);

/// Returns red, green and blue as shown: clamped to 0..1, NaN as 0; of a grey picture the same plane three
/// times.
std::array<Plane, 3> shown_colours(const Image& image);

// Structural similarity: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment:
// from error visibility to structural similarity", IEEE Trans. Image Processing 13(4), 2004.

/// The width of the window, which is the smallest side of a picture with an SSIM.
inline constexpr int k_ssim_window = 11;

/// Returns the mean SSIM over all window positions (Gaussian of deviation 1.5; K1 = 0.01, K2 = 0.03, peak 1)
/// and over red, green and blue as shown; 1 for equal pictures. Returns NaN for pictures smaller than the
/// window. Both must have the same size.
double ssim(const Image& left, const Image& right);

// LDR-FLIP: the perceived difference of two pictures when flipping between them. P. Andersson, J. Nilsson, T.
// Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020.

/// The paper's viewer: a display 0.7 m and 3840 pixels wide, 0.7 m away.
inline constexpr double k_pixels_per_degree = 0.7 * 3840 / 0.7 * 3.14159265358979323846 / 180.0;

struct Flip {
    Plane map;         ///< 0 (same) to 1 for each pixel
    double mean = 0.0; ///< the main result in the paper
    double largest = 0.0;
};

/// Compares two pictures as sRGB, clamped to 0..1. Both must have the same size.
Flip flip(const Image& reference, const Image& test, double pixels_per_degree = k_pixels_per_degree);

// Makes pictures that show where and how much two pictures differ.

/// Maps 0..1 to a colour of rising brightness: black, blue, red, orange, pale yellow. Clamps other values.
std::array<float, 3> heat(double value);

/// Draws a plane of 0..1 in the colours of `heat`; NaN is magenta.
Image heat_map(const Plane& plane);

/// Returns |left - right| times `gain`, sample by sample, without alpha. Pixels with a NaN or infinity that
/// is not the same in both pictures are magenta. Both must have the same size and number of channels.
Image difference_picture(const Image& left, const Image& right, double gain);

// Measures the difference of two pictures, sample by sample and as perceived. Gives no verdict.

/// u8 samples count as v/255. Two NaN are equal, as are two infinities of one sign. For any other pair with a
/// non-finite sample the difference is undefined: it makes `rmse`, `psnr` and `relative_mse` NaN, so that no
/// threshold passes; `largest` ignores it. The left picture is the reference.
struct PictureDifference {
    double largest = 0.0; ///< largest absolute difference of two samples
    double rmse = 0.0;    ///< root of the mean square over all samples
    double psnr = 0.0;    ///< dB for a peak of 1; infinite for equal pictures
    /// Mean of (test - reference)² / (|reference| + 0.01)², as pbrt's MRSE; equal infinities count as 0.
    double relative_mse = 0.0;
    size_t pixels = 0;
    size_t differing = 0;       ///< pixels with a sample that differs by more than the tolerance
    size_t one_non_finite = 0;  ///< pixels that have a NaN or infinity in one picture only
    size_t both_non_finite = 0; ///< pixels that have one in both

    double differing_share() const { return pixels == 0 ? 0.0 : double(differing) / double(pixels); }
    bool equal() const { return differing == 0; }
};

/// Compares two pictures, which may differ in sample type. A different size or number of channels is an error
/// (ErrorCode::check_failed). `tolerance` affects only `differing`.
Result<PictureDifference> compare(const Image& left, const Image& right, double tolerance = 0.0);

/// All metrics of a picture against its reference. `ssim` and the two of FLIP are NaN if `rmse` is.
struct PictureMetrics {
    PictureDifference samples;
    double ssim = 1.0;         ///< structural similarity, see `ssim` of pictures
    double flip = 0.0;         ///< mean of the map of `flip`
    double largest_flip = 0.0; ///< largest of a pixel
};

Result<PictureMetrics> measure(const Image& reference, const Image& test, double tolerance = 0.0);

// Gives two pictures the same channels so that they can be compared: grey becomes red, green and blue, and a
// missing alpha is 1. Reports these changes; measures nothing.

struct SameChannels {
    Image left;
    Image right;
    std::string note; ///< describes the changes, with A for left and B for right; empty: none
};

/// Gives both pictures the same channels. An alpha that only one picture has is dropped if it is 1
/// everywhere; otherwise the other picture gets an alpha of 1 and the two differ in it.
SameChannels same_channels(Image left, Image right);

} // namespace tidemark::image
