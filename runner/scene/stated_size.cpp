#include "scene/stated_size.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::scene {

std::optional<Extent> size_of_text(std::string_view text) {
    const auto extent = parse_extent(text);
    return extent && std::max(extent->width, extent->height) <= k_largest_stated_side ? extent : std::nullopt;
}

std::string to_string(const Extent& size) {
    return fmt::format("{}x{}", size.width, size.height);
}

} // namespace tidemark::scene
