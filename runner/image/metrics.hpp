// How far two pictures are apart, sample by sample, in numbers. No perception, no tolerance, no verdict.
#pragma once

#include "base/result.hpp"
#include "image/image.hpp"

#include <cstddef>

namespace tidemark::image {

/// u8 samples count as v/255. Two NaN are equal, as are two infinities of one sign; any other pair with a
/// non-finite sample has no difference in numbers: it makes `rmse` and `psnr` NaN, so that no threshold
/// passes, and leaves `largest`, which is over the other pairs, useful.
struct PictureDifference {
    double largest = 0.0; ///< largest absolute difference of two samples
    double rmse = 0.0;    ///< root of the mean square over all samples
    double psnr = 0.0;    ///< dB for a peak of 1; infinite for equal pictures
    size_t pixels = 0;
    size_t differing = 0;       ///< pixels with a sample that differs
    size_t one_non_finite = 0;  ///< pixels that have a NaN or infinity in one picture only
    size_t both_non_finite = 0; ///< pixels that have one in both

    double differing_share() const { return pixels == 0 ? 0.0 : double(differing) / double(pixels); }
    bool equal() const { return differing == 0; }
};

/// The pictures may differ in sample type; a different size or number of channels is an error
/// (ErrorCode::check_failed).
Result<PictureDifference> compare(const Image& left, const Image& right);

} // namespace tidemark::image
