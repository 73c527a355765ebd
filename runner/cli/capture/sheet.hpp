// A contact sheet: moments of a scene in one picture, row by row from the top left.
#pragma once

#include "base/result.hpp"
#include "image/image.hpp"

#include <string_view>

namespace tidemark::cli {

struct SheetGrid {
    int columns = 1;
    int rows = 1;

    size_t cells() const { return size_t(columns) * size_t(rows); }
    /// Returns the size of the sheet for cells of this size, including the gaps.
    Extent extent(Extent cell) const;
};

/// Parses columns and rows, for example `5x4`.
Result<SheetGrid> parse_sheet(std::string_view text);

class Sheet {
public:
    explicit Sheet(SheetGrid grid) : grid_(grid) {}

    /// Adds the next cell; all have the same size and type and four channels.
    void add(const image::Image& cell);
    const image::Image& picture() const { return picture_; }

private:
    SheetGrid grid_;
    int added_ = 0;
    image::Image picture_;
};

} // namespace tidemark::cli
