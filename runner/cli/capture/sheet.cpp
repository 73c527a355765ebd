#include "cli/capture/sheet.hpp"

#include "base/extent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace tidemark::cli {
namespace {

constexpr int k_gap = 8;         ///< pixels
/// Grey of the gaps: neither black nor white, which are common at the edges of scenes.
constexpr uint8_t k_grey = 0x20;
constexpr size_t k_most_cells = 1000;

/// Returns an opaque grey picture.
image::Image blank(Extent extent, image::SampleType type) {
    image::Image picture(extent, 4, type);
    for (size_t i = 0; i < picture.samples(); ++i) {
        const uint8_t sample = i % 4 == 3 ? 0xff : k_grey;
        if (type == image::SampleType::u8)
            picture.u8()[i] = sample;
        else
            picture.f32()[i] = float(sample) / 255;
    }
    return picture;
}

} // namespace

Extent SheetGrid::extent(Extent cell) const {
    return {columns * cell.width + (columns - 1) * k_gap, rows * cell.height + (rows - 1) * k_gap};
}

Result<SheetGrid> parse_sheet(std::string_view text) {
    const auto cells = parse_extent(text);
    if (!cells || cells->pixels() > k_most_cells)
        return fail(ErrorCode::usage,
                    fmt::format("--sheet {}: give columns and rows, as in 5x4, {} cells at most", text,
                                k_most_cells));
    return SheetGrid{cells->width, cells->height};
}

void Sheet::add(const image::Image& cell) {
    if (added_ == 0)
        picture_ = blank(grid_.extent(cell.extent), cell.type);
    assert(cell.channels == 4 && cell.type == picture_.type && grid_.extent(cell.extent) == picture_.extent);
    const int column = added_ % grid_.columns, row = added_ / grid_.columns;
    const size_t pixel = 4 * image::size_of(cell.type);
    const int left = column * (cell.extent.width + k_gap);
    const int bottom = (grid_.rows - 1 - row) * (cell.extent.height + k_gap);
    for (int y = 0; y < cell.extent.height; ++y)
        std::copy_n(cell.bytes.begin() + std::ptrdiff_t(size_t(y) * cell.row_bytes()), cell.row_bytes(),
                    picture_.bytes.begin() +
                        std::ptrdiff_t(size_t(bottom + y) * picture_.row_bytes() + size_t(left) * pixel));
    ++added_;
}

} // namespace tidemark::cli
