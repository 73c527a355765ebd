// Averages pictures in linear light, as the eye or a film does: samples are taken as sRGB, decoded, added and
// encoded again. Colours are weighted by their straight alpha; a pixel with alpha 0 in all pictures is black.
#pragma once

#include "image/image.hpp"

#include <vector>

namespace tidemark::image {

/// Mean of RGBA pictures in floats. A pixel that is NaN or infinite in one of them is so in the mean.
class LightMean {
public:
    /// `clamped`: colours beyond 0 to 1 count as displayed.
    explicit LightMean(bool clamped) : clamped_(clamped) {}

    /// Adds a picture, of the same size as those before.
    void add(const Image& picture);
    /// Writes the mean of the added pictures into `mean` and starts again.
    void take(Image& mean);

private:
    bool clamped_;
    int count_ = 0;
    std::vector<double> sums_;
};

} // namespace tidemark::image
