#include "render/picture_parts.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace tidemark::render::tile_grid_test {

constexpr int k_limit = 16384;

TEST(TileGridTest, tiles_cover_each_pixel_once_from_even_origins) {
    for (const Extent whole : {Extent{1, 1}, {2, 2}, {7, 5}, {64, 64}, {65, 63}, {161, 91}, {20, 301}})
        for (const Extent tile : {Extent{2, 2}, {6, 10}, {64, 2}, {64, 64}}) {
            const TileGrid grid(whole, tile);
            std::vector<int> covered(whole.pixels());
            for (int band = 0; band < grid.bands(); ++band)
                for (int column = 0; column < grid.columns(); ++column) {
                    const Tile at = grid.at(column, band);
                    EXPECT_EQ(at.x % 2 + at.y % 2, 0);
                    EXPECT_LE(at.extent.width, tile.width);
                    EXPECT_LE(at.extent.height, tile.height);
                    ASSERT_GE(at.extent.width, 1);
                    ASSERT_GE(at.extent.height, 1);
                    for (int y = at.y; y < at.y + at.extent.height; ++y)
                        for (int x = at.x; x < at.x + at.extent.width; ++x)
                            ++covered.at(size_t(y) * size_t(whole.width) + size_t(x));
                }
            EXPECT_THAT(covered, testing::Each(1));
            EXPECT_EQ(grid.count(), size_t(grid.columns()) * size_t(grid.bands()));
        }
}

TEST(TileGridTest, bands_start_at_the_top_with_the_remainder) {
    const TileGrid grid({100, 70}, {64, 32});
    EXPECT_EQ(grid.columns(), 2);
    EXPECT_EQ(grid.bands(), 3);
    EXPECT_EQ(grid.at(0, 0), (Tile{0, 64, {64, 6}}));
    EXPECT_EQ(grid.at(1, 1), (Tile{64, 32, {36, 32}}));
    EXPECT_EQ(grid.at(1, 2), (Tile{64, 0, {36, 32}}));
}

TEST(TileGridTest, pictures_up_to_4k_are_drawn_whole) {
    for (const Extent whole : {Extent{1, 1}, {640, 360}, {3840, 2160}, {4096, 2160}, {16384, 540}})
        EXPECT_EQ(tile_for(whole, 16, k_limit), std::nullopt) << whole.width;
}

TEST(TileGridTest, larger_pictures_and_longer_sides_are_cut) {
    EXPECT_EQ(tile_for({7680, 4320}, 4, k_limit), (Extent{1024, 256}));
    EXPECT_EQ(tile_for({16384, 16384}, 4, k_limit), (Extent{1024, 256}));
    EXPECT_EQ(tile_for({16385, 1}, 4, k_limit), (Extent{1024, 256}));
    EXPECT_EQ(tile_for({1, 20000}, 16, k_limit), (Extent{1024, 256}));
    EXPECT_EQ(tile_for({3000, 3000}, 4, 2048), (Extent{1024, 256}));
}

TEST(TileGridTest, bands_fit_into_memory_and_tiles_into_the_driver) {
    for (const int width : {20'000, 100'000, 1'000'000, k_largest_tiled_side})
        for (const size_t pixel : {size_t{4}, size_t{16}})
            for (const int limit : {2048, k_limit}) {
                const auto tile = tile_for({width, 1000}, pixel, limit);
                ASSERT_TRUE(tile);
                EXPECT_LE(size_t(width) * size_t(tile->height) * pixel,
                          std::max(size_t{64} << 20, size_t(width) * 2 * pixel));
                EXPECT_LE(tile->width, limit);
                EXPECT_EQ(tile->width % 2 + tile->height % 2, 0);
                EXPECT_GE(tile->height, 2);
            }
    EXPECT_EQ(tile_for({1'000'000, 1000}, 16, k_limit), (Extent{k_limit, 4}));
}

TEST(TileGridTest, requested_sides_are_even_and_within_the_limit) {
    EXPECT_EQ(*tile_of_side(2, k_limit), (Extent{2, 2}));
    EXPECT_EQ(*tile_of_side(k_limit, k_limit), (Extent{k_limit, k_limit}));
    for (const int side : {-2, 0, 1, 7, k_limit + 2}) {
        const auto refused = tile_of_side(side, k_limit);
        ASSERT_FALSE(refused) << side;
        EXPECT_EQ(refused.error().code, ErrorCode::usage);
    }
    EXPECT_EQ(tile_of_side(7, 16384).error().message,
              "--tile 7: give an even number of pixels from 2 to 16384");
}

} // namespace tidemark::render::tile_grid_test
