// The transfer function of sRGB (IEC 61966-2-1) between a sample and linear light. It continues below 0 and
// above 1 as in scRGB: odd about 0 and unbounded.
#pragma once

#include <cmath>

namespace tidemark::image {

/// Meaning of the samples of a file. Colours have BT.709's primaries and white.
enum class Transfer {
    data,  ///< numbers without colour, such as a buffer's state
    srgb,  ///< display values, as ShaderToy's Image writes them
    linear ///< linear light
};

/// Decodes a sample. The error is that of two roundings and of pow.
inline double light_of_srgb(double sample) {
    const double size = std::abs(sample);
    return std::copysign(size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4), sample);
}

inline double srgb_of_light(double light) {
    const double size = std::abs(light);
    return std::copysign(size <= 0.0031308 ? 12.92 * size : 1.055 * std::pow(size, 1 / 2.4) - 0.055, light);
}

} // namespace tidemark::image
