#include "bake/ramps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace tidemark::bake {

using image::Image;
using image::SampleType;
namespace {

/// Returns 0 up to `from` and 1 beyond `to`, with a smooth transition. Uses sums and products only: the same
/// bits on every machine.
double rise(double from, double to, double x) {
    const double part = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part);
}

constexpr int k_size = 64;

using Rgba = std::array<double, 4>;

/// One colour of a palette and the place, 0..1, at which it is reached.
struct Stop {
    double at;
    Rgba color;
};

Rgba blend(const Rgba& a, const Rgba& b, double part) {
    Rgba result{};
    for (size_t i = 0; i < result.size(); ++i) {
        result[i] = a[i] + part * (b[i] - a[i]);
    }
    return result;
}

/// Returns the colour at `x`; `stops` are in rising order.
Rgba palette(std::span<const Stop> stops, double x) {
    Rgba color = stops.front().color;
    for (size_t i = 1; i < stops.size(); ++i) {
        color = blend(color, stops[i].color, rise(stops[i - 1].at, stops[i].at, x));
    }
    return color;
}

/// Troughs show the depth below, crests the light through them; towards the horizon only the reflected sky
/// and the air remain, and the contrast fades.
Rgba water(double lightness, double distance) {
    static constexpr std::array<Stop, 6> k_near{{
        {0.00, {0.015, 0.130, 0.225, 1.0}},
        {0.30, {0.020, 0.215, 0.325, 1.0}},
        {0.52, {0.035, 0.315, 0.425, 1.0}},
        {0.72, {0.100, 0.450, 0.535, 1.0}},
        {0.88, {0.290, 0.640, 0.690, 1.0}},
        {1.00, {0.640, 0.860, 0.870, 1.0}},
    }};
    static constexpr std::array<Stop, 4> k_middle{{
        {0.00, {0.035, 0.175, 0.305, 1.0}},
        {0.45, {0.075, 0.305, 0.455, 1.0}},
        {0.75, {0.250, 0.515, 0.650, 1.0}},
        {1.00, {0.680, 0.855, 0.900, 1.0}},
    }};
    static constexpr std::array<Stop, 3> k_far{{
        {0.00, {0.420, 0.600, 0.720, 1.0}},
        {0.50, {0.560, 0.720, 0.810, 1.0}},
        {1.00, {0.760, 0.865, 0.905, 1.0}},
    }};
    const Rgba up_to_middle =
        blend(palette(k_near, lightness), palette(k_middle, lightness), rise(0.0, 0.22, distance));
    return blend(up_to_middle, palette(k_far, lightness), rise(0.08, 1.0, distance));
}

/// Only the lightest part of the noise breaks into foam, and less of it with distance.
Rgba foam(double lightness, double distance) {
    const double from = 0.64 + 0.12 * distance;
    const double cover = rise(from, from + 0.3, lightness) * (1.0 - 0.66 * rise(0.0, 0.7, distance));
    const Rgba near{0.94, 0.985, 0.98, cover};
    const Rgba far{0.86, 0.925, 0.95, cover};
    return blend(near, far, distance);
}

/// Returns height, front, tail and rollback.
Rgba wave(double phase) {
    const double climb = rise(0.02, 0.70, phase);
    const double fall = 1.0 - rise(0.70, 0.86, phase);
    const double height = (0.3 * climb + 0.7 * climb * climb * climb) * fall;
    const double front = rise(0.69, 0.75, phase) * (1.0 - rise(0.80, 0.85, phase));
    const double behind = rise(0.24, 0.72, phase);
    const double tail = behind * behind * (1.0 - rise(0.72, 0.78, phase));
    const double rollback = rise(0.02, 0.14, phase) * (1.0 - rise(0.22, 0.58, phase));
    return {height, front, tail, rollback};
}

Image draw_wave() {
    constexpr int size = 256;
    Image image({size, 1}, 4, SampleType::f32);
    size_t next = 0;
    for (int x = 0; x < size; ++x)
        for (const double sample : wave((x + 0.5) / size))
            image.f32()[next++] = float(sample);
    return image;
}

template <class Color>
Image draw(Color color) {
    Image image({k_size, k_size}, 4, SampleType::u8);
    auto samples = image.u8();
    size_t next = 0;
    for (int y = 0; y < k_size; ++y) {
        for (int x = 0; x < k_size; ++x) {
            for (const double sample : color((x + 0.5) / k_size, (y + 0.5) / k_size)) {
                samples[next++] = uint8_t(std::lround(255.0 * std::clamp(sample, 0.0, 1.0)));
            }
        }
    }
    return image;
}

} // namespace

std::vector<NamedImage> make_ramps() {
    return {{"water_ramp", draw(water)}, {"foam_ramp", draw(foam)}, {"wave_ramps", draw_wave()}};
}

} // namespace tidemark::bake
