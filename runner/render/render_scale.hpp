// Rendered pixels per window pixel along a side: a power of two.
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
    RenderScale() = default; ///< 1: renders each window pixel
    /// Lists the scales from the smallest to the largest.
    static std::vector<RenderScale> all();
    /// Finds the scale of that `name`.
    static std::optional<RenderScale> named(std::string_view name);

    /// Returns `1/4`, `1` or `2`, for example.
    std::string name() const;
    /// Returns the size to render for a window of that size; at least one pixel a side.
    Extent drawn(Extent window) const;
    /// Returns the scale `steps` powers of two higher, or lower if negative, within the range.
    RenderScale stepped(int steps) const;
    /// Returns the number of steps from `other` to this scale.
    int steps_from(RenderScale other) const { return exponent_ - other.exponent_; }

    auto operator<=>(const RenderScale&) const = default;

private:
    explicit RenderScale(int exponent) : exponent_(exponent) {}

    int exponent_ = 0;
};

} // namespace tidemark::render
