#include "render/picture_parts.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

namespace tidemark::render::part_size_test {

constexpr Extent k_extent{640, 360};

/// Milliseconds of a part: what the driver takes for itself, and what its rows' pixels take.
using Cost = std::function<double(int row)>;

double cost_of(const Part& part, const Cost& of_pixel) {
    double sum = 0.2;
    for (int row = part.area.y; row < part.area.y + part.area.extent.height; ++row)
        sum += of_pixel(row) * part.area.extent.width;
    return sum;
}

/// Draws a frame and returns the time of each part.
std::vector<double> draw(PartSize& size, const Cost& of_pixel) {
    PartCursor cursor({{0, k_extent, 1}});
    std::vector<double> took;
    while (const auto ahead = cursor.ahead()) {
        const Part part = *cursor.take(size.pixels(*ahead));
        took.push_back(cost_of(part, of_pixel));
        size.drew(part, k_extent, took.back());
    }
    return took;
}

TEST(PartSizeTest, a_fast_frame_has_few_parts) {
    PartSize size;
    EXPECT_LE(draw(size, [](int) { return 1e-6; }).size(), 7u);
    EXPECT_LE(draw(size, [](int) { return 1e-6; }).size(), 2u) << "the second knows";
}

TEST(PartSizeTest, even_pixels_come_in_parts_of_about_25_milliseconds) {
    for (const double of_pixel : {1e-3, 1e-2, 0.1}) {
        PartSize size;
        draw(size, [&](int) { return of_pixel; });
        const auto took = draw(size, [&](int) { return of_pixel; });
        EXPECT_LE(std::ranges::max(took), 30) << of_pixel;
        const double sum = of_pixel * double(k_extent.pixels());
        EXPECT_LE(double(took.size()), 2 * sum / 25 + 10) << of_pixel;
    }
}

TEST(PartSizeTest, no_part_is_smaller_than_a_block) {
    PartSize size;
    const Part block{0, 0, {0, 0, {4, 4}}};
    size.drew(block, k_extent, 5000);
    EXPECT_EQ(size.pixels({0, 0, {4, 0, {636, 4}}}), 16u);
}

TEST(PartSizeTest, costs_of_rows_are_kept_for_the_next_frame) {
    const Cost sky_and_sea = [](int row) { return row < 200 ? 2e-2 : 1e-6; };
    const Cost sea_and_sky = [](int row) { return row < 200 ? 1e-6 : 2e-2; };
    for (const Cost& cost : {sky_and_sea, sea_and_sky}) {
        PartSize size;
        draw(size, cost);
        EXPECT_LE(std::ranges::max(draw(size, cost)), 50);
        EXPECT_LE(std::ranges::max(draw(size, cost)), 50);
    }
}

TEST(PartSizeTest, only_the_first_part_of_a_suddenly_slow_frame_is_slow) {
    PartSize size;
    draw(size, [](int) { return 1e-4; });
    const auto took = draw(size, [](int) { return 1e-2; });
    EXPECT_EQ(std::ranges::count_if(took, [](double ms) { return ms > 50; }), 1);
}

TEST(PartSizeTest, doubted_sizes_start_with_a_small_part) {
    PartSize size;
    draw(size, [](int) { return 1e-5; });
    size.doubt(k_extent.pixels() / 16);
    EXPECT_LE(draw(size, [](int) { return 1e-5; }).size(), 4u) << "few where it was in vain";
    size.doubt(k_extent.pixels() / 16);
    const auto took = draw(size, [](int) { return 1e-3; });
    EXPECT_LE(std::ranges::max(took), 20 + 1e-3 * double(k_extent.pixels()) / 16);
    size.doubt(0);
    EXPECT_EQ(size.pixels({0, 0, {0, 0, k_extent}}), 256u);
}

TEST(PartSizeTest, the_rest_of_a_row_does_not_change_the_estimate) {
    PartSize size;
    size.drew({0, 0, {0, 0, {640, 64}}}, k_extent, 2);
    const size_t before = size.pixels({0, 0, {0, 64, {640, 296}}});
    size.drew({0, 0, {636, 64, {4, 4}}}, k_extent, 0.3);
    EXPECT_EQ(size.pixels({0, 0, {0, 68, {640, 292}}}), before);
}

TEST(PartSizeTest, a_new_height_keeps_the_costs_of_common_rows) {
    PartSize size;
    size.drew({0, 0, {0, 0, {640, 100}}}, {640, 100}, 6400);
    size.drew({0, 0, {0, 0, {320, 8}}}, {320, 50}, 1);
    EXPECT_LE(size.pixels({0, 0, {0, 8, {320, 42}}}), 320u) << "the rows that both have";
}

} // namespace tidemark::render::part_size_test
