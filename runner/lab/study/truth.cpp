#include "lab/study/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {

void add_blind(const image::Image& picture, PixelMask& blind) {
    blind.resize(picture.extent.pixels(), false);
    const auto samples = picture.f32();
    const auto channels = size_t(picture.channels);
    for (size_t i = 0; i < samples.size(); ++i)
        if (!std::isfinite(samples[i]))
            blind[i / channels] = true;
}

std::string too_blind(size_t blind, size_t pixels) {
    if (double(blind) <= k_most_blind * double(pixels))
        return {};
    return fmt::format("{:.3g} % of its pixels are NaN or infinite", 100.0 * double(blind) / double(pixels));
}

std::vector<double> plain_footprint(Extent extent) {
    return std::vector<double>(extent.pixels(), 1.0 / extent.height);
}

double pooled_rmse(const std::vector<image::Image>& left, const std::vector<image::Image>& right,
                   const std::vector<PixelMask>& blind) {
    double squares = 0;
    size_t samples = 0;
    for (size_t i = 0; i < left.size(); ++i) {
        const auto a = left[i].f32(), b = right[i].f32();
        const auto channels = size_t(left[i].channels);
        for (size_t k = 0; k < a.size(); ++k) {
            if (i < blind.size() && !blind[i].empty() && blind[i][k / channels])
                continue;
            const double change = double(a[k]) - double(b[k]); // NaN stays NaN
            squares += change * change;
            ++samples;
        }
    }
    return std::sqrt(squares / double(std::max<size_t>(1, samples)));
}

} // namespace tidemark::lab
