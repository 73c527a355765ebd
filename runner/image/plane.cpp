#include "image/plane.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tidemark::image {
namespace {

/// Convolves a row or a column: `step` is 1 along rows and the width along columns.
void convolve_line(const double* from, double* to, int length, size_t step, const Kernel& kernel) {
    const int radius = int(kernel.size() / 2);
    for (int i = 0; i < length; ++i) {
        double sum = 0.0;
        for (int k = -radius; k <= radius; ++k)
            sum += kernel[size_t(k + radius)] * from[size_t(std::clamp(i + k, 0, length - 1)) * step];
        to[size_t(i) * step] = sum;
    }
}

} // namespace

Kernel gaussian(double deviation, int radius) {
    Kernel kernel;
    for (int x = -radius; x <= radius; ++x)
        kernel.push_back(std::exp(-double(x * x) / (2.0 * deviation * deviation)));
    return kernel;
}

Plane convolved(const Plane& plane, const Kernel& row, const Kernel& column) {
    assert(row.size() % 2 == 1 && column.size() % 2 == 1);
    const auto width = size_t(plane.extent.width);
    Plane across(plane.extent), result(plane.extent);
    for (int y = 0; y < plane.extent.height; ++y)
        convolve_line(&plane.values[size_t(y) * width], &across.values[size_t(y) * width], plane.extent.width,
                      1, row);
    for (size_t x = 0; x < width; ++x)
        convolve_line(&across.values[x], &result.values[x], plane.extent.height, width, column);
    return result;
}

Plane channel_of(const Image& image, int channel) {
    Plane plane(image.extent);
    const auto channels = size_t(image.channels);
    for (size_t i = 0; i < plane.values.size(); ++i) {
        const size_t sample = i * channels + size_t(channel);
        plane.values[i] = image.type == SampleType::u8 ? image.u8()[sample] / 255.0 : image.f32()[sample];
    }
    return plane;
}

std::array<Plane, 3> shown_colours(const Image& image) {
    std::array<Plane, 3> colours;
    for (int i = 0; i < 3; ++i) {
        colours[size_t(i)] = channel_of(image, image.channels < 3 ? 0 : i);
        for (double& value : colours[size_t(i)].values)
            value = value > 0.0 ? std::min(value, 1.0) : 0.0; // NaN gives 0
    }
    return colours;
}

} // namespace tidemark::image
