// Cuts pictures that exceed the driver's limit or the memory into tiles. Pure.
#pragma once

#include "base/rectangle.hpp"
#include "base/result.hpp"

#include <optional>

namespace tidemark::render {

using Tile = Rectangle;

/// The largest side at which gl_FragCoord is exact: pixel centres lie at halves, which floats can hold up to
/// here.
inline constexpr int k_largest_tiled_side = 1 << 23;

/// Tiles from the bottom left corner on. Their sides are even, so that the 2x2 pixels for derivatives and
/// mipmaps are those of the whole picture. Tiles on the right and at the top are cut off at the picture's
/// edge.
class TileGrid {
public:
    TileGrid(Extent whole, Extent tile) : whole_(whole), tile_(tile) {}

    int columns() const { return (whole_.width + tile_.width - 1) / tile_.width; }
    /// Returns the number of bands; a band is a row of tiles.
    int bands() const { return (whole_.height + tile_.height - 1) / tile_.height; }
    size_t count() const { return size_t(columns()) * size_t(bands()); }
    Extent tile() const { return tile_; }
    /// Returns the tile at a column from the left and a band from the top, in the row order of files.
    Tile at(int column, int band) const;

private:
    Extent whole_;
    Extent tile_;
};

/// Returns the tile size for a picture with `pixel_bytes` bytes a pixel: about as many pixels as a frame of
/// the default size, so that no tile keeps a GPU busy longer, in bands of limited memory. Returns nothing
/// when the picture is best drawn whole: no side exceeds `largest_target`, and it has at most as many pixels
/// as 4K.
std::optional<Extent> tile_for(Extent whole, size_t pixel_bytes, int largest_target);

/// Returns square tiles of `side` pixels, as for `--tile`. Fails (ErrorCode::usage) when `side` is odd, below
/// 2 or above `largest_target`.
Result<Extent> tile_of_side(int side, int largest_target);

} // namespace tidemark::render
