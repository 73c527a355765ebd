// The size of a picture, target or window in pixels.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace tidemark {

struct Extent {
    int width = 0;
    int height = 0;

    bool operator==(const Extent&) const = default;
    size_t pixels() const { return size_t(width) * size_t(height); }
};

/// Parses `640x360`; nullopt for any other text or a side below 1.
std::optional<Extent> parse_extent(std::string_view text);

} // namespace tidemark
