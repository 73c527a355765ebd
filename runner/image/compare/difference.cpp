#include "image/compare/difference.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tidemark::image {
namespace {

using Colour = std::array<float, 3>;

constexpr Colour k_magenta{1.0f, 0.0f, 1.0f};
constexpr Colour k_heat[] = {{0.0f, 0.0f, 0.02f},
                             {0.13f, 0.07f, 0.45f},
                             {0.72f, 0.13f, 0.33f},
                             {0.99f, 0.58f, 0.16f},
                             {1.0f, 1.0f, 0.75f}};

/// Returns the absolute difference, 0 for equal values, and NaN for any other pair with a NaN or infinity.
double distance(double a, double b) {
    if (a == b || (std::isnan(a) && std::isnan(b)))
        return 0.0;
    return std::isfinite(a) && std::isfinite(b) ? std::abs(a - b) : std::nan("");
}

} // namespace

Colour heat(double value) {
    constexpr int k_last = int(std::size(k_heat)) - 1;
    const double place = std::clamp(value, 0.0, 1.0) * k_last;
    const int below = std::min(int(place), k_last - 1);
    const auto part = float(place - below);
    Colour colour{};
    for (size_t c = 0; c < 3; ++c)
        colour[c] = k_heat[below][c] + part * (k_heat[below + 1][c] - k_heat[below][c]);
    return colour;
}

Image heat_map(const Plane& plane) {
    Image image(plane.extent, 3, SampleType::f32);
    for (size_t i = 0; i < plane.values.size(); ++i) {
        const double value = plane.values[i];
        std::ranges::copy(std::isnan(value) ? k_magenta : heat(value),
                          image.f32().begin() + ptrdiff_t(3 * i));
    }
    return image;
}

Image difference_picture(const Image& left, const Image& right, double gain) {
    assert(left.extent == right.extent && left.channels == right.channels);
    std::array<Plane, 3> planes;
    for (int c = 0; c < 3; ++c) {
        const int channel = left.channels < 3 ? 0 : c;
        const Plane a = channel_of(left, channel), b = channel_of(right, channel);
        planes[size_t(c)] = Plane(left.extent);
        for (size_t i = 0; i < a.values.size(); ++i)
            planes[size_t(c)].values[i] = gain * distance(a.values[i], b.values[i]);
    }
    Image image(left.extent, 3, SampleType::f32);
    for (size_t i = 0; i < image.extent.pixels(); ++i) {
        Colour colour{float(planes[0].values[i]), float(planes[1].values[i]), float(planes[2].values[i])};
        if (std::ranges::any_of(colour, [](float v) { return std::isnan(v); }))
            colour = k_magenta;
        std::ranges::copy(colour, image.f32().begin() + ptrdiff_t(3 * i));
    }
    return image;
}

} // namespace tidemark::image
