#include "base/extent.hpp"

#include <fmt/format.h>

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

std::optional<Rectangle> parse_rectangle(std::string_view text) {
    Rectangle area;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (int* const number : {&area.x, &area.y, &area.extent.width, &area.extent.height}) {
        if (number != &area.x && (at == end || *at++ != ','))
            return std::nullopt;
        const auto [after, error] = std::from_chars(at, end, *number);
        if (error != std::errc{})
            return std::nullopt;
        at = after;
    }
    return at == end && area.extent.width >= 1 && area.extent.height >= 1 ? std::optional(area)
                                                                          : std::nullopt;
}

std::string to_string(const Rectangle& area) {
    return fmt::format("{},{},{},{}", area.x, area.y, area.extent.width, area.extent.height);
}

} // namespace tidemark
