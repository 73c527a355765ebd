#include "lab/check/picture_gap.hpp"

#include "lab/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tidemark::lab {

double p99_difference(const image::Image& left, const image::Image& right) {
    std::vector<double> largest(left.extent.pixels());
    const auto channels = size_t(left.channels);
    for (size_t i = 0; i < left.samples(); ++i) {
        const double difference = std::abs(double(left.f32()[i]) - double(right.f32()[i]));
        // What is a number in one only is as different as can be.
        const bool same =
            left.f32()[i] == right.f32()[i] || (std::isnan(left.f32()[i]) && std::isnan(right.f32()[i]));
        double& most = largest[i / channels];
        most = std::max(most, same ? 0.0 : std::isfinite(difference) ? difference : 1.0);
    }
    return quantile(std::move(largest), 0.99);
}

} // namespace tidemark::lab
