// Counts the samples of a picture that are not ordinary numbers, and locates the first. Tests bits, so that
// neither compiler flags nor flush to zero change the result.
#pragma once

#include "image/image.hpp"

#include <cstddef>
#include <optional>

namespace tidemark::image {

/// One sample: column, row from the bottom, channel.
struct SamplePlace {
    int x = 0;
    int y = 0;
    int channel = 0;

    bool operator==(const SamplePlace&) const = default;
};

/// Counts of samples. "First" is in memory order: the bottom row first, from left to right.
struct FiniteCensus {
    size_t samples = 0;
    size_t nan = 0;
    size_t positive_infinity = 0;
    size_t negative_infinity = 0;
    size_t subnormal = 0;
    size_t beyond_half = 0; ///< finite, but an infinity when it is rounded to a half
    std::optional<SamplePlace> first_non_finite{};
    std::optional<SamplePlace> first_subnormal{};

    size_t non_finite() const { return nan + positive_infinity + negative_infinity; }
    bool operator==(const FiniteCensus&) const = default;
};

FiniteCensus census(const Image& image);

/// Counts the pixels of a picture of floats whose alpha is below 0 or above 1. Ignores NaN.
size_t pixels_of_no_coverage(const Image& image);

/// Alpha of a byte pixel whose value was NaN or infinite when drawn, because bytes cannot hold these.
inline constexpr uint8_t k_non_finite_alpha = 51;

/// Counts the pixels with a NaN or an infinity: floats by their bits, bytes by k_non_finite_alpha, which it
/// sets to 1.
size_t take_non_finite(Image& image);

} // namespace tidemark::image
