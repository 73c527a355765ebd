// Cuts pictures that exceed the driver's limit or the memory into tiles. Pure.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

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

// Iterates over a frame that is drawn in parts: pass by pass, face by face, from the bottom row up; every
// pixel once, in parts of the size that the caller requests. Pure.

/// The pixels of a pass.
struct PassArea {
    size_t pass = 0; ///< index into Scene::passes
    Extent extent;   ///< of a face
    int faces = 1;
};

/// Pixels that are drawn at once: whole rows, or some columns of a few rows.
struct Part {
    size_t pass = 0;
    int face = 0;
    Rectangle area;

    bool operator==(const Part&) const = default;
};

/// Block side of a driver on the CPU: parts begin and end at a block or at the picture's edge. The 2x2 blocks
/// for derivatives therefore lie within one part.
inline constexpr int k_block_side = 4;

class PartCursor {
public:
    explicit PartCursor(std::vector<PassArea> areas) : areas_(std::move(areas)) {}

    /// Returns the largest part that may be next; nothing when the frame is complete.
    std::optional<Part> ahead() const;
    /// Returns the next part, of about `pixels` pixels and more only if a block has more, and advances past
    /// it.
    std::optional<Part> take(size_t pixels);
    /// Skips the rest of the current pass.
    void leave_out();

    /// Returns whether the current pass has no parts taken yet.
    bool begins_pass() const { return face_ == 0 && y_ == 0 && x_ == 0; }
    /// Returns the fraction of all pixels that were taken, 0 to 1.
    double share() const;

private:
    Rectangle cut(const Rectangle& rest, size_t pixels) const;
    void pass_by(const Rectangle& area);

    std::vector<PassArea> areas_;
    size_t index_ = 0; ///< of the current area
    int face_ = 0;
    int y_ = 0;    ///< bottom row of the rest of the face
    int x_ = 0;    ///< first remaining column in the current rows
    int rows_ = 0; ///< number of current rows, if x_ is not 0
};

// Chooses the size of a frame's parts so that the driver finishes each in about 25 ms, from the times of the
// last parts and of the same rows in the last frame. Pure.

class PartSize {
public:
    /// Returns the pixels of the next part, which begins where `ahead` does. Without measurements the first
    /// part is small, and the next ones grow.
    size_t pixels(const Part& ahead) const;
    /// Records the time of a part, in a face of that size.
    void drew(const Part& part, Extent face, double milliseconds);

    /// Limits the next part to `pixels`; for changes after which frames may take a different time.
    void doubt(size_t pixels) { recent_ = std::min(recent_, std::max(pixels, k_first)); }

private:
    size_t known_pixels(const Part& ahead, const std::vector<double>& rows) const;

    static constexpr size_t k_first = 256;

    size_t recent_ = k_first; ///< estimate from the last parts
    /// Milliseconds per pixel in each row of a pass's face, the mean of the last drawing; 0: not drawn yet.
    std::map<std::pair<size_t, int>, std::vector<double>> rows_;
};

} // namespace tidemark::render
