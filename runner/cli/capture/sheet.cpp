#include "cli/capture/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>

namespace tidemark::cli {
namespace {

constexpr int k_gap = 8;         ///< pixels
constexpr uint8_t k_grey = 0x20; ///< of the gaps: neither black nor white, which scenes have at their edges
constexpr int k_most_cells = 1000;

/// Opaque grey all over.
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
    SheetGrid grid;
    const char* const end = text.data() + text.size();
    const auto columns = std::from_chars(text.data(), end, grid.columns);
    const bool cross = columns.ec == std::errc() && columns.ptr != end && *columns.ptr == 'x';
    if (cross) {
        const auto rows = std::from_chars(columns.ptr + 1, end, grid.rows);
        if (rows.ec == std::errc() && rows.ptr == end && grid.columns > 0 && grid.rows > 0 &&
            grid.columns <= k_most_cells && grid.rows <= k_most_cells && grid.cells() <= k_most_cells)
            return grid;
    }
    return fail(
        ErrorCode::usage,
        fmt::format("--sheet {}: give columns and rows, as in 5x4, {} cells at most", text, k_most_cells));
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
