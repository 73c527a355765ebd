// Measures the difference of two pictures, sample by sample and as perceived. Gives no verdict.
#pragma once

#include "base/result.hpp"
#include "image/image.hpp"

#include <cstddef>

namespace tidemark::image {

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

} // namespace tidemark::image
