#include "scene/stated_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace tidemark::scene {

std::optional<Extent> size_of_text(std::string_view text) {
    Extent extent;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, extent.width);
    if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x')
        return std::nullopt;
    const auto height = std::from_chars(width.ptr + 1, end, extent.height);
    const bool fits = std::min(extent.width, extent.height) >= 1 &&
                      std::max(extent.width, extent.height) <= k_largest_stated_side;
    return height.ec == std::errc{} && height.ptr == end && fits ? std::optional(extent) : std::nullopt;
}

std::string to_string(const Extent& size) {
    return fmt::format("{}x{}", size.width, size.height);
}

} // namespace tidemark::scene
