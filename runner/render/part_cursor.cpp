#include "render/part_cursor.hpp"

#include <algorithm>

namespace tidemark::render {
namespace {

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

} // namespace

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

} // namespace tidemark::render
