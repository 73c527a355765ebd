// Planes of one number per pixel, and filters for them, as perceptual metrics use them. Independent of files
// and colour.
#pragma once

#include "base/extent.hpp"
#include "image/image.hpp"

#include <array>
#include <cstddef>
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

} // namespace tidemark::image
