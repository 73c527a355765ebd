// Values of uniforms with bitwise comparison.
#pragma once

#include "scene/channel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace tidemark::render {

/// The value of one uniform, in GL's order of components.
class UniformNumbers {
public:
    UniformNumbers(std::initializer_list<double> values) { append(values.begin(), values.end()); }
    explicit UniformNumbers(std::span<const double> values) { append(values.begin(), values.end()); }

    template <class Iterator>
    void append(Iterator begin, Iterator end) {
        for (; begin != end; ++begin)
            values_[count_++] = double(*begin);
    }
    operator std::span<const double>() const { return {values_.data(), count_}; }

    /// Compares bits: a NaN equals itself, and -0 differs from 0. A shader can distinguish them.
    bool operator==(const UniformNumbers& other) const {
        const auto bits = [](double value) { return std::bit_cast<uint64_t>(value); };
        return std::ranges::equal(std::span<const double>(*this), std::span<const double>(other), {}, bits,
                                  bits);
    }

private:
    /// The length of iChannelResolution, the longest value.
    std::array<double, 3 * scene::k_channel_count> values_{};
    size_t count_ = 0;
};

/// The values of all active uniforms of a program.
using UniformValues = std::vector<UniformNumbers>;

} // namespace tidemark::render
