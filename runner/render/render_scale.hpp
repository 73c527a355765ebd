// How many pixels of a window's picture are drawn for one that is shown, along a side: a power of two.
#pragma once

#include "base/extent.hpp"

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::render {

class RenderScale {
public:
    RenderScale() = default; ///< 1: each pixel that is shown is drawn
    /// From the smallest to the largest.
    static std::vector<RenderScale> all();
    /// As `name` has it.
    static std::optional<RenderScale> named(std::string_view name);

    /// `1/4`, `1`, `2`.
    std::string name() const;
    /// What is drawn for a window of that size: a pixel at least.
    Extent drawn(Extent window) const;
    /// So many powers of two up, below zero down, as far as there are any.
    RenderScale stepped(int steps) const;
    /// How many steps it is from there.
    int steps_from(RenderScale other) const { return exponent_ - other.exponent_; }

    auto operator<=>(const RenderScale&) const = default;

private:
    explicit RenderScale(int exponent) : exponent_(exponent) {}

    int exponent_ = 0;
};

} // namespace tidemark::render
