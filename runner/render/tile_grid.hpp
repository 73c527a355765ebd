// Cuts a picture into tiles: one that is larger than a target may be, or than memory should hold. Pure.
#pragma once

#include "base/rectangle.hpp"
#include "base/result.hpp"

#include <optional>

namespace tidemark::render {

using Tile = Rectangle;

/// Pixels centre on halves, which floats have up to here: gl_FragCoord is exact in a picture of this side.
inline constexpr int k_largest_tiled_side = 1 << 23;

/// Tiles from the bottom left corner on. Their sides are even, so that the 2x2 pixels that derivatives and
/// mipmaps are taken from are those of the whole picture; what sticks out on the right and at the top is left
/// out.
class TileGrid {
public:
    TileGrid(Extent whole, Extent tile) : whole_(whole), tile_(tile) {}

    int columns() const { return (whole_.width + tile_.width - 1) / tile_.width; }
    /// A row of tiles is a band of the picture.
    int bands() const { return (whole_.height + tile_.height - 1) / tile_.height; }
    size_t count() const { return size_t(columns()) * size_t(bands()); }
    Extent tile() const { return tile_; }
    /// Columns from the left; bands from the top, as files have their rows.
    Tile at(int column, int band) const;

private:
    Extent whole_;
    Extent tile_;
};

/// The tiles for a picture of that many bytes a pixel: as many pixels as a frame of the default size has, so
/// that none keeps a GPU longer, in bands that memory can hold. Nothing where the picture is best drawn
/// whole: no side is longer than `largest_target`, and there are no more pixels than 4K has.
std::optional<Extent> tile_for(Extent whole, size_t pixel_bytes, int largest_target);

/// Square tiles of `side` pixels, as `--tile` asks for; fails (ErrorCode::usage) on a side that no target may
/// have.
Result<Extent> tile_of_side(int side, int largest_target);

} // namespace tidemark::render
