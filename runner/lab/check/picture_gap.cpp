#include "lab/check/picture_gap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tidemark::lab {

double p99_difference(const image::Image& left, const image::Image& right) {
    std::vector<float> largest(left.extent.pixels());
    const auto channels = size_t(left.channels);
    for (size_t i = 0; i < left.samples(); ++i) {
        const float difference = std::abs(left.f32()[i] - right.f32()[i]);
        // What is a number in one only is as different as can be.
        const bool same =
            left.f32()[i] == right.f32()[i] || (std::isnan(left.f32()[i]) && std::isnan(right.f32()[i]));
        float& most = largest[i / channels];
        most = std::max(most, same ? 0.0f : std::isnan(difference) ? 1.0f : difference);
    }
    const auto at = largest.begin() + std::ptrdiff_t(double(largest.size() - 1) * 0.99);
    std::ranges::nth_element(largest, at);
    return double(*at);
}

size_t different_pixels(const image::Image& left, const image::Image& right) {
    const auto pixel = std::ptrdiff_t(left.row_bytes()) / left.extent.width;
    size_t count = 0;
    for (auto a = left.bytes.begin(), b = right.bytes.begin(); a != left.bytes.end(); a += pixel, b += pixel)
        count += !std::equal(a, a + pixel, b);
    return count;
}

} // namespace tidemark::lab
