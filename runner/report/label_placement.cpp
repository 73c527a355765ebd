#include "report/label_placement.hpp"

#include <algorithm>
#include <array>

namespace tidemark::report {
namespace {

/// Distance from the middle of a mark to its label, pixels.
constexpr double k_distance = 8;

/// Returns eight places around a mark, the preferred ones first.
std::array<Box, 8> places(const Label& label) {
    const auto at = [&](double left, double top) {
        return Box{left, top, left + label.width, top + k_label_height};
    };
    const double right = label.x + k_distance, left = label.x - k_distance - label.width;
    const double above = label.y - k_distance - k_label_height, below = label.y + k_distance;
    const double middle = label.y - k_label_height / 2, centre = label.x - label.width / 2;
    return {at(right, above),  at(right, below),  at(left, above),   at(left, below),
            at(centre, above), at(centre, below), at(right, middle), at(left, middle)};
}

} // namespace

std::vector<std::optional<Box>> place_labels(std::span<const Label> labels, std::span<const Box> obstacles,
                                             const Box& bounds) {
    std::vector<Box> taken(obstacles.begin(), obstacles.end());
    std::vector<std::optional<Box>> placed;
    for (const Label& label : labels) {
        const auto tried = places(label);
        const auto free = std::ranges::find_if(tried, [&](const Box& place) {
            return bounds.holds(place) &&
                   std::ranges::none_of(taken, [&](const Box& box) { return place.overlaps(box); });
        });
        placed.push_back(free == tried.end() ? std::nullopt : std::optional(*free));
        if (placed.back())
            taken.push_back(*placed.back());
    }
    return placed;
}

} // namespace tidemark::report
