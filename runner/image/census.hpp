// How many samples of a picture are not ordinary numbers, and where the first of them is. Judges by bits,
// so that no compiler flag and no flush to zero changes the answer.
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

} // namespace tidemark::image
