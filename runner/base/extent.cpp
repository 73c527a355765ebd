#include "base/extent.hpp"

#include "base/encoding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace tidemark {

std::optional<Extent> parse_extent(std::string_view text) {
    const std::vector<int> sides = numbers_from<int>(text, 'x');
    return sides.size() == 2 && std::ranges::min(sides) >= 1 ? std::optional(Extent{sides[0], sides[1]})
                                                             : std::nullopt;
}

std::optional<Rectangle> parse_rectangle(std::string_view text) {
    const std::vector<int> numbers = numbers_from<int>(text);
    if (numbers.size() != 4 || numbers[2] < 1 || numbers[3] < 1)
        return std::nullopt;
    return Rectangle{numbers[0], numbers[1], {numbers[2], numbers[3]}};
}

std::string to_string(const Rectangle& area) {
    return fmt::format("{},{},{},{}", area.x, area.y, area.extent.width, area.extent.height);
}

} // namespace tidemark
