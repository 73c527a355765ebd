#include "render/picture_parts.hpp"

#include <fmt/format.h>

namespace tidemark::render {
namespace {

constexpr size_t k_whole_pixels = 4096 * 2160;
constexpr int k_tile_pixels = 1 << 18; ///< 640x360 has 0.88 times as many
constexpr int k_tile_height = 256;
constexpr size_t k_band_bytes = size_t{64} << 20;

/// Keeps the 64x64 blocks that llvmpipe assigns to its threads whole in large parts.
constexpr int k_large_rows = 64;

int whole_blocks(size_t pixels) {
    return std::max(int(pixels) / k_block_side, 1) * k_block_side;
}

/// Divides columns evenly, so that the last part is not a small rest.
int evenly(int columns, int most) {
    const int parts = (columns + most - 1) / most;
    const int blocks = (columns + parts * k_block_side - 1) / (parts * k_block_side);
    return std::min(blocks * k_block_side, columns);
}

size_t pixels_of(const PassArea& area) {
    return area.extent.pixels() * size_t(area.faces);
}

constexpr double k_wanted_ms = 25;
/// Below this time, the driver's overhead outweighs the pixels.
constexpr double k_telling_ms = 3;
/// Largest growth from one part to the next, because the cost of adjacent pixels may differ a lot.
constexpr double k_growth = 2;
constexpr double k_growth_of_quick = 8;
constexpr size_t k_block = size_t(k_block_side) * k_block_side;
constexpr size_t k_most = size_t{1} << 30;

} // namespace

Tile TileGrid::at(int column, int band) const {
    const int x = column * tile_.width;
    const int y = (bands() - 1 - band) * tile_.height;
    return {x, y, {std::min(tile_.width, whole_.width - x), std::min(tile_.height, whole_.height - y)}};
}

std::optional<Extent> tile_for(Extent whole, size_t pixel_bytes, int largest_target) {
    if (std::max(whole.width, whole.height) <= largest_target && whole.pixels() <= k_whole_pixels)
        return std::nullopt;
    int height = k_tile_height;
    while (height > 2 && size_t(whole.width) * pixel_bytes * size_t(height) > k_band_bytes)
        height /= 2;
    return Extent{std::min(k_tile_pixels / height, largest_target), height};
}

Result<Extent> tile_of_side(int side, int largest_target) {
    if (side < 2 || side > largest_target || side % 2 != 0)
        return fail(ErrorCode::usage, fmt::format("--tile {}: give an even number of pixels from 2 to {}",
                                                  side, largest_target));
    return Extent{side, side};
}

std::optional<Part> PartCursor::ahead() const {
    if (index_ == areas_.size())
        return std::nullopt;
    const PassArea& area = areas_[index_];
    const int rows = x_ > 0 ? rows_ : area.extent.height - y_;
    return Part{area.pass, face_, {x_, y_, {area.extent.width - x_, rows}}};
}

std::optional<Part> PartCursor::take(size_t pixels) {
    auto part = ahead();
    if (!part)
        return part;
    part->area = cut(part->area, pixels);
    pass_by(part->area);
    return part;
}

/// Takes as many whole rows as fit; if not even the fewest rows fit, as many of their columns as fit.
/// llvmpipe's threads share rows by columns.
Rectangle PartCursor::cut(const Rectangle& rest, size_t pixels) const {
    Rectangle area = rest;
    pixels = std::min(pixels, rest.extent.pixels());
    if (x_ == 0) {
        int rows = whole_blocks(pixels / size_t(rest.extent.width));
        const int over = (rest.y + rows) % k_large_rows;
        if (rows < rest.extent.height && rows - over >= k_large_rows)
            rows -= over;
        area.extent.height = std::min(rows, rest.extent.height);
    }
    if (area.extent.pixels() > pixels)
        area.extent.width = evenly(rest.extent.width, whole_blocks(pixels / size_t(area.extent.height)));
    return area;
}

void PartCursor::pass_by(const Rectangle& area) {
    const PassArea& whole = areas_[index_];
    x_ = area.x + area.extent.width;
    rows_ = area.extent.height;
    if (x_ < whole.extent.width)
        return;
    x_ = 0;
    y_ += rows_;
    if (y_ < whole.extent.height)
        return;
    y_ = 0;
    if (++face_ < whole.faces)
        return;
    face_ = 0;
    ++index_;
}

void PartCursor::leave_out() {
    if (index_ == areas_.size())
        return;
    x_ = y_ = face_ = 0;
    ++index_;
}

double PartCursor::share() const {
    size_t all = 0;
    size_t behind = 0;
    for (size_t i = 0; i < areas_.size(); ++i) {
        all += pixels_of(areas_[i]);
        if (i < index_)
            behind += pixels_of(areas_[i]);
    }
    if (index_ < areas_.size()) {
        const auto width = size_t(areas_[index_].extent.width);
        behind +=
            areas_[index_].extent.pixels() * size_t(face_) + width * size_t(y_) + size_t(x_) * size_t(rows_);
    }
    return all == 0 ? 1 : double(behind) / double(all);
}

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
