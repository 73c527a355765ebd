#include "render/tile_grid.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::render {
namespace {

constexpr size_t k_whole_pixels = 4096 * 2160;
constexpr int k_tile_pixels = 1 << 18; ///< 640x360 has 0.88 times as many
constexpr int k_tile_height = 256;
constexpr size_t k_band_bytes = size_t{64} << 20;

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

} // namespace tidemark::render
