#include "base/extent.hpp"

#include <charconv>

namespace tidemark {

std::optional<Extent> parse_extent(std::string_view text) {
    Extent extent;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, extent.width);
    if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x')
        return std::nullopt;
    const auto height = std::from_chars(width.ptr + 1, end, extent.height);
    const bool whole = height.ec == std::errc{} && height.ptr == end;
    return whole && extent.width >= 1 && extent.height >= 1 ? std::optional(extent) : std::nullopt;
}

} // namespace tidemark
