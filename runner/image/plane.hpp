// One number a pixel, and filters over them: what perceptual metrics are made of. No files, no colour.
#pragma once

#include "base/extent.hpp"
#include "image/image.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace tidemark::image {

/// Rows from the bottom, as an Image has them.
struct Plane {
    Extent extent;
    std::vector<double> values;

    explicit Plane(Extent size = {}, double value = 0.0) : extent(size), values(size.pixels(), value) {}
    double at(int x, int y) const { return values[size_t(y) * size_t(extent.width) + size_t(x)]; }
};

/// Weights for the offsets -radius..radius; their number is odd.
using Kernel = std::vector<double>;

/// exp(-x² / (2 deviation²)) for the offsets -radius..radius, not normalised.
Kernel gaussian(double deviation, int radius);

/// `row` along x, then `column` along y. Pixels beyond the edge are those of the edge.
Plane convolved(const Plane& plane, const Kernel& row, const Kernel& column);

/// A channel of a picture: bytes as v / 255, floats as they are.
Plane channel_of(const Image& image, int channel);

/// Red, green and blue as they are shown: clamped to 0..1, NaN as 0; of a grey picture three times the same.
std::array<Plane, 3> shown_colours(const Image& image);

} // namespace tidemark::image
