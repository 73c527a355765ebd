// The values of uniforms, comparable to the bit.
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

/// What one uniform is told, in the order GL takes the numbers.
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

    /// To the bit: a NaN equals itself, and -0 is not 0. A shader can tell them apart.
    bool operator==(const UniformNumbers& other) const {
        const auto bits = [](double value) { return std::bit_cast<uint64_t>(value); };
        return std::ranges::equal(std::span<const double>(*this), std::span<const double>(other), {}, bits,
                                  bits);
    }

private:
    std::array<double, 3 * scene::k_channel_count> values_{}; ///< no value is longer than iChannelResolution
    size_t count_ = 0;
};

/// Of all active uniforms of a program.
using UniformValues = std::vector<UniformNumbers>;

} // namespace tidemark::render
