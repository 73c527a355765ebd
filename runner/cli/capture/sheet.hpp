// A contact sheet: moments of a scene side by side in one picture, from the top left on, row by row.
#pragma once

#include "base/result.hpp"
#include "image/image.hpp"

#include <string_view>

namespace tidemark::cli {

struct SheetGrid {
    int columns = 1;
    int rows = 1;

    size_t cells() const { return size_t(columns) * size_t(rows); }
    /// With the gaps between cells of that size.
    Extent extent(Extent cell) const;
};

/// `5x4`: columns and rows.
Result<SheetGrid> parse_sheet(std::string_view text);

class Sheet {
public:
    explicit Sheet(SheetGrid grid) : grid_(grid) {}

    /// The next cell; all are of one size and type, with four channels.
    void add(const image::Image& cell);
    const image::Image& picture() const { return picture_; }

private:
    SheetGrid grid_;
    int added_ = 0;
    image::Image picture_;
};

} // namespace tidemark::cli
