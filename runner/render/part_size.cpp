#include "render/part_size.hpp"

#include <algorithm>

namespace tidemark::render {
namespace {

constexpr double k_wanted_ms = 25;
/// Below this time, the driver's overhead outweighs the pixels.
constexpr double k_telling_ms = 3;
/// Largest growth from one part to the next, because the cost of adjacent pixels may differ a lot.
constexpr double k_growth = 2;
constexpr double k_growth_of_quick = 8;
constexpr size_t k_block = size_t(k_block_side) * k_block_side;
constexpr size_t k_most = size_t{1} << 30;

} // namespace

size_t PartSize::pixels(const Part& ahead) const {
    const auto known = rows_.find({ahead.pass, ahead.face});
    return known == rows_.end() ? recent_ : std::min(recent_, known_pixels(ahead, known->second));
}

/// Returns how many pixels take the wanted time, by the times of their rows in the last frame.
size_t PartSize::known_pixels(const Part& ahead, const std::vector<double>& rows) const {
    const auto width = double(ahead.area.extent.width);
    double left = k_wanted_ms;
    for (int row = 0; row < ahead.area.extent.height; ++row) {
        const auto at = size_t(ahead.area.y + row);
        const double took = at < rows.size() ? rows[at] * width : 0;
        if (took >= left)
            return std::max(size_t((row + left / took) * width), k_block);
        left -= took;
    }
    return k_most;
}

void PartSize::drew(const Part& part, Extent face, double milliseconds) {
    const auto pixels = double(part.area.extent.pixels());
    if (milliseconds >= k_telling_ms) {
        const double wanted = pixels * k_wanted_ms / milliseconds;
        recent_ = size_t(std::clamp(wanted, double(k_block), k_growth * std::max(double(recent_), pixels)));
    } else if (pixels >= double(recent_) / 2) { // excludes the rest of a row
        recent_ = std::min(size_t(k_growth_of_quick * double(recent_)), k_most);
    }
    std::vector<double>& rows = rows_[{part.pass, part.face}];
    rows.resize(size_t(face.height));
    const double of_row = milliseconds / part.area.extent.height / face.width;
    for (int row = part.area.y; row < part.area.y + part.area.extent.height; ++row)
        rows[size_t(row)] = of_row + (part.area.x > 0 ? rows[size_t(row)] : 0);
}

} // namespace tidemark::render
