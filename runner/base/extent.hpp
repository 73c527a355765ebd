// The size of a picture, target or window in pixels.
#pragma once

#include "base/encoding.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark {

struct Extent {
    int width = 0;
    int height = 0;

    bool operator==(const Extent&) const = default;
    size_t pixels() const { return size_t(width) * size_t(height); }
};

/// Parses `640x360`; nullopt for any other text or a side below 1.
inline std::optional<Extent> parse_extent(std::string_view text) {
    const std::vector<int> sides = numbers_from<int>(text, 'x');
    return sides.size() == 2 && std::ranges::min(sides) >= 1 ? std::optional(Extent{sides[0], sides[1]})
                                                             : std::nullopt;
}

// A part of a picture, target or window in whole pixels; x and y are its bottom left pixel.

struct Rectangle {
    int x = 0;
    int y = 0;
    Extent extent;

    bool operator==(const Rectangle&) const = default;

    bool contains(int column, int row) const {
        return column >= x && row >= y && column - x < extent.width && row - y < extent.height;
    }
    /// Returns the common pixels; an empty extent if there are none.
    Rectangle within(const Rectangle& other) const {
        const int left = std::max(x, other.x);
        const int bottom = std::max(y, other.y);
        const int right = std::min(x + extent.width, other.x + other.extent.width);
        const int top = std::min(y + extent.height, other.y + other.extent.height);
        return {left, bottom, {std::max(0, right - left), std::max(0, top - bottom)}};
    }
};

/// Parses `100,50,320,180`: left, bottom, width and height; nullopt for any other text or a side below 1.
inline std::optional<Rectangle> parse_rectangle(std::string_view text) {
    const std::vector<int> numbers = numbers_from<int>(text);
    if (numbers.size() != 4 || numbers[2] < 1 || numbers[3] < 1)
        return std::nullopt;
    return Rectangle{numbers[0], numbers[1], {numbers[2], numbers[3]}};
}
/// Returns the text that parse_rectangle reads.
inline std::string to_string(const Rectangle& area) {
    return std::to_string(area.x) + ',' + std::to_string(area.y) + ',' + std::to_string(area.extent.width) +
           ',' + std::to_string(area.extent.height);
}

} // namespace tidemark
