#include "bake/wave_map.hpp"
#include "base/encoding.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace tidemark::bake::wave_map_test {

using image::Image;
using image::SampleType;

struct Texel {
    float path, mask, depth, height;
};

Texel texel(const Image& image, int x, int y) {
    const auto at = image.f32().subspan(4 * size_t(y * image.extent.width + x), 4);
    return {at[0], at[1], at[2], at[3]};
}

/// A round island of `radius` at `middle` in water 2 m deep.
HeightMap round_island(int side, Point middle, double radius) {
    HeightMap map(side, 64.0);
    for (int node = 0; node < side * side; ++node)
        map.heights[size_t(node)] = std::max(radius - distance(map.position(node), middle), -2.0);
    return map;
}

std::string refusal(const HeightMap& map) {
    const auto baked = bake_wave_map(map);
    return baked ? "" : baked.error().message;
}

TEST(WaveMap, is_finite_and_in_range) {
    for (const uint32_t seed : {k_island_seed, 1U, 2U, 3U, 4U}) {
        const auto baked = bake_wave_map(make_island(128, seed));
        ASSERT_TRUE(baked) << seed << ": " << baked.error().message;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x) {
                const Texel t = texel(*baked, x, y);
                EXPECT_TRUE(std::isfinite(t.path)) << x << ' ' << y;
                EXPECT_TRUE(t.mask >= 0.0F && t.mask <= 1.0F) << x << ' ' << y;
                EXPECT_EQ(t.depth, std::max(-t.height, 0.0F)) << x << ' ' << y;
            }
    }
}

TEST(WaveMap, open_water_and_the_weather_side_are_straight_and_white) {
    const HeightMap map = round_island(256, {8.0, 3.0}, 4.0);
    const Image baked = bake_wave_map(map).value();
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const Point p = map.position(map.node(x, y));
            if (!map.is_water(map.node(x, y)) || p.x * 8.0 + p.y * 3.0 > 0.0 || length(p) < 2.0)
                continue; // the half of the map that the island is not in
            EXPECT_NEAR(texel(baked, x, y).path, 30.0 - length(p), 0.03) << x << ' ' << y;
            EXPECT_EQ(texel(baked, x, y).mask, 1.0F) << x << ' ' << y;
        }
}

TEST(WaveMap, lee_of_an_island_is_black) {
    const HeightMap map = round_island(256, {12.0, 0.0}, 5.0);
    const Image baked = bake_wave_map(map).value();
    // Just inwards of the island: a quarter round it to come here.
    const Texel lee = texel(baked, 128 + 4 * 6, 128);
    EXPECT_GT(lee.path, 30.0F - 6.0F + 1.0F);
    EXPECT_EQ(lee.mask, 0.0F);
    EXPECT_EQ(texel(baked, 128 + 4 * 20, 128).mask, 1.0F); // before it
}

// The picture is a square grid and not a polar one, so no direction is a seam; and neither is the shore.
TEST(WaveMap, has_no_seam) {
    const HeightMap map = make_island(256);
    const Image baked = bake_wave_map(map).value();
    const double spacing = map.spacing();
    int at_shore = 0;
    for (int y = 0; y + 1 < 256; ++y)
        for (int x = 0; x + 1 < 256; ++x)
            for (const int across : {1, 0}) {
                const int node = map.node(x, y), beside = map.node(x + across, y + 1 - across);
                const bool both_dry = !map.is_water(node) && !map.is_water(beside);
                if (both_dry)
                    continue; // where the land's middle is as near to two shores
                at_shore += map.is_water(node) != map.is_water(beside);
                const Texel a = texel(baked, x, y), b = texel(baked, x + across, y + 1 - across);
                EXPECT_LE(std::abs(a.path - b.path), 2.0 * spacing) << x << ' ' << y;
            }
    EXPECT_GT(at_shore, 300);
}

TEST(WaveMap, continues_inland_from_the_nearest_shore) {
    const HeightMap map = round_island(256, {10.0, 0.0}, 5.0);
    const Image baked = bake_wave_map(map).value();
    const auto path = [&](double x) { return texel(baked, int((x + 32.0) * 4.0), 128).path; };
    // 2 m inland on either side: as far inland from the shore there, not over land from the other side.
    EXPECT_NEAR(path(13.0), 30.0 - 13.0, 0.3);
    EXPECT_NEAR(path(7.0) - path(4.9), 2.1, 0.3);
    EXPECT_GT(path(7.0), 30.0 - 7.0 + 2.0);
}

TEST(WaveMap, lakes_get_values_like_land) {
    HeightMap map = round_island(128, {0.0, 0.0}, 8.0);
    for (int node = 0; node < 128 * 128; ++node)
        if (length(map.position(node)) < 3.0)
            map.heights[size_t(node)] = -1.0;
    const Image baked = bake_wave_map(map).value();
    // 22 m to the shore and 7.65 from there, each known to a node.
    EXPECT_NEAR(texel(baked, 64, 64).path, 29.65, 0.5);
}

TEST(WaveMap, refuses_maps_without_water_or_open_circle) {
    HeightMap dry(64, 64.0);
    for (double& height : dry.heights)
        height = 0.25;
    EXPECT_EQ(refusal(dry), "there is no water: the lowest height is 0.25 m above the sea; raise --sea");
    EXPECT_THAT(refusal(round_island(64, {29.0, 0.0}, 3.0)),
                testing::StartsWith(
                    "the circle where the waves start, 30 m round the middle, meets land at column "));
    EXPECT_EQ(refusal(round_island(64, {0.0, 0.0}, 20.0)), "");
    EXPECT_EQ(refusal(round_island(64, {-40.0, 0.0}, 4.0)), ""); // land outside
}

TEST(HeightsFrom, scales_and_shifts_the_first_channel) {
    Image picture({64, 64}, 3, SampleType::u8);
    picture.u8()[3 * (64 * 5 + 7)] = 255;
    const HeightMap map = heights_from(picture, 100.0, 0.25, 8.0).value();
    EXPECT_EQ(map.heights[size_t(map.node(7, 5))], 6.0);
    EXPECT_EQ(map.heights[0], -2.0);
    EXPECT_EQ(map.spacing(), 100.0 / 64.0);
}

TEST(HeightsFrom, refuses_other_shapes_and_values) {
    const auto why = [](const Image& picture) {
        const auto map = heights_from(picture, 64.0, 0.0, 1.0);
        return map ? "" : map.error().message;
    };
    EXPECT_EQ(why(Image({300, 200}, 1, SampleType::u8)), "a height map is square; this picture is 300x200");
    EXPECT_EQ(why(Image({63, 63}, 1, SampleType::u8)),
              "a height map has 64 to 4096 pixels a side; this one has 63");
    Image picture({64, 64}, 1, SampleType::f32);
    picture.f32()[64 * 60 + 3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(why(picture), "the height at column 3, row 3 is not a number");
    picture.f32()[64 * 60 + 3] = -std::numeric_limits<float>::infinity();
    EXPECT_EQ(why(picture), "the height at column 3, row 3 is infinite");
    picture.f32()[64 * 60 + 3] = -2e4F;
    EXPECT_EQ(why(picture), "the height at column 3, row 3 is -2e+04 m, beyond 10000; see --metres");
}

TEST(Island, is_the_same_terrain_at_every_size) {
    const HeightMap coarse = make_island(64), fine = make_island(192); // every third node is the same place
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            EXPECT_NEAR(coarse.heights[size_t(coarse.node(x, y))],
                        fine.heights[size_t(fine.node(3 * x + 1, 3 * y + 1))], 1e-9)
                << x << ' ' << y;
}

TEST(Island, has_land_rocks_and_an_open_sea) {
    for (const uint32_t seed : {k_island_seed, 1U, 2U, 3U}) {
        const HeightMap map = make_island(128, seed);
        int land = 0;
        for (int node = 0; node < 128 * 128; ++node) {
            land += !map.is_water(node);
            if (length(map.position(node)) > 27.0) {
                EXPECT_NEAR(map.heights[size_t(node)], -5.0, 1e-12);
            }
            EXPECT_LT(map.heights[size_t(node)], 6.0); // map_top of the scene
        }
        EXPECT_GT(land, 600) << seed;
        EXPECT_LT(land, 5000) << seed;
    }
}

TEST(Island, has_the_same_bits_on_every_machine) {
    const auto baked = bake_wave_map(make_island(64));
    EXPECT_EQ(sha256(baked->bytes), "f57f5d8084fc6788eff5058be71edd108ed60fae6aca389b16c4255471a8c536");
}

// The file that `tidemark_bake` writes is read back: it may be compressed differently elsewhere.
TEST(Island, equals_the_file_in_textures) {
    namespace fs = std::filesystem;
    const fs::path file = fs::temp_directory_path() / fmt::format("tidemark-island-{}.exr", ::getpid());
    const Image baked = bake_wave_map(make_island(512)).value();
    ASSERT_TRUE(image::write_picture(file, baked, {image::SampleDepth::half, {}}));
    const auto written = image::read_picture(file);
    fs::remove(file);
    const auto kept = image::read_picture(fs::path(TIDEMARK_SOURCE_DIR) / "textures/island.exr");
    ASSERT_TRUE(written && kept);
    EXPECT_TRUE(*written == *kept);
    for (size_t i = 0; i < baked.samples(); ++i) // half floats: 11 bits
        ASSERT_NEAR(kept->f32()[i], baked.f32()[i], std::abs(baked.f32()[i]) / 2048.0F + 1e-7F) << i;
}

} // namespace tidemark::bake::wave_map_test
