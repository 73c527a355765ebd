// Places labels beside marks so that none covers another label, a mark, or the edge. Greedy, in the given
// order; pure.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace tidemark::report {

/// A rectangle in pixels, y downwards.
struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;

    bool overlaps(const Box& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
    bool holds(const Box& other) const {
        return left <= other.left && other.right <= right && top <= other.top && other.bottom <= bottom;
    }
};

struct Label {
    double x = 0, y = 0; ///< position of its mark
    double width = 0;    ///< width of its text
};

inline constexpr double k_label_height = 14;

/// Returns a place beside each mark, within `bounds`, on the right if possible; nothing if every place covers
/// an obstacle or an earlier label.
std::vector<std::optional<Box>> place_labels(std::span<const Label> labels, std::span<const Box> obstacles,
                                             const Box& bounds);

} // namespace tidemark::report
