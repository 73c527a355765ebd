// The mean of pictures as light adds up, and as the eye or a film would take it: samples are taken as sRGB,
// decoded, added and encoded again. A colour counts as much as it covers: by its straight alpha; where
// nothing covers a pixel it is black.
#pragma once

#include "image/image.hpp"

#include <vector>

namespace tidemark::image {

/// Of RGBA pictures in floats. A pixel that is NaN or infinite in one of them is so in the mean.
class LightMean {
public:
    /// `clamped`: colours beyond 0 to 1 count as what a display shows of them.
    explicit LightMean(bool clamped) : clamped_(clamped) {}

    /// Of the size of those before it.
    void add(const Image& picture);
    /// Of all that were added; begins anew.
    void take(Image& mean);

private:
    bool clamped_;
    int count_ = 0;
    std::vector<double> sums_;
};

} // namespace tidemark::image
