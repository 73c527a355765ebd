// The transfer function of sRGB (IEC 61966-2-1), between what a sample holds and the light that it stands
// for. Below 0 and above 1 it goes on as scRGB's does: odd about 0, without a bound.
#pragma once

#include <cmath>

namespace tidemark::image {

/// What the samples of a file stand for. Colours are those of BT.709's primaries and white.
enum class Transfer {
    data,  ///< numbers, such as the state that a buffer keeps: no colours
    srgb,  ///< as a display takes them, which is what ShaderToy's Image writes
    linear ///< light
};

/// Error: that of two roundings and of pow.
inline double light_of_srgb(double sample) {
    const double size = std::abs(sample);
    return std::copysign(size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4), sample);
}

inline double srgb_of_light(double light) {
    const double size = std::abs(light);
    return std::copysign(size <= 0.0031308 ? 12.92 * size : 1.055 * std::pow(size, 1 / 2.4) - 0.055, light);
}

} // namespace tidemark::image
