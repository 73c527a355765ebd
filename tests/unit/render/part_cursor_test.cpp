#include "render/picture_parts.hpp"

#include <gmock/gmock.h>

#include <map>

namespace tidemark::render::part_cursor_test {

/// How often each pixel of a pass's face was taken.
using Counts = std::map<std::pair<size_t, int>, std::vector<int>>;

std::vector<Part> all_parts(PartCursor cursor, const std::vector<size_t>& sizes) {
    std::vector<Part> parts;
    for (size_t i = 0; const auto part = cursor.take(sizes[i % sizes.size()]); ++i)
        parts.push_back(*part);
    return parts;
}

Counts counts_of(const std::vector<Part>& parts, const std::vector<PassArea>& areas) {
    Counts counts;
    for (const PassArea& area : areas)
        for (int face = 0; face < area.faces; ++face)
            counts[{area.pass, face}].resize(area.extent.pixels());
    for (const Part& part : parts) {
        const Rectangle& area = part.area;
        const auto of_pass = std::ranges::find(areas, part.pass, &PassArea::pass);
        for (int y = area.y; y < area.y + area.extent.height; ++y)
            for (int x = area.x; x < area.x + area.extent.width; ++x)
                ++counts.at({part.pass, part.face}).at(size_t(y * of_pass->extent.width + x));
    }
    return counts;
}

const std::vector<PassArea> k_areas{{0, {97, 61}, 1}, {3, {64, 64}, 6}, {4, {1, 200}, 1}, {7, {97, 61}, 1}};

TEST(PartCursorTest, every_pixel_is_taken_once_for_all_sizes) {
    const std::vector<std::vector<size_t>> sizes{{1}, {16}, {97 * 4}, {500, 17, 9000, 40}, {size_t{1} << 40}};
    for (const auto& wanted : sizes)
        for (const auto& [place, counts] : counts_of(all_parts(PartCursor(k_areas), wanted), k_areas))
            EXPECT_THAT(counts, testing::Each(1)) << "pass " << place.first << ", face " << place.second;
}

TEST(PartCursorTest, passes_and_faces_keep_their_order) {
    std::vector<std::pair<size_t, int>> order;
    for (const Part& part : all_parts(PartCursor(k_areas), {700, 50}))
        if (const std::pair now{part.pass, part.face}; order.empty() || order.back() != now)
            order.push_back(now);
    EXPECT_THAT(order, testing::ElementsAre(testing::Pair(0, 0), testing::Pair(3, 0), testing::Pair(3, 1),
                                            testing::Pair(3, 2), testing::Pair(3, 3), testing::Pair(3, 4),
                                            testing::Pair(3, 5), testing::Pair(4, 0), testing::Pair(7, 0)));
}

TEST(PartCursorTest, parts_start_at_blocks_within_the_requested_size) {
    for (const size_t wanted : {16u, 100u, 400u, 2000u})
        for (const Part& part : all_parts(PartCursor(k_areas), {wanted})) {
            EXPECT_EQ(part.area.x % k_block_side, 0);
            EXPECT_EQ(part.area.y % k_block_side, 0);
            EXPECT_LE(part.area.extent.pixels(), wanted);
        }
}

TEST(PartCursorTest, large_parts_are_whole_rows_up_to_a_multiple_of_64) {
    PartCursor cursor({{0, {100, 300}, 1}});
    EXPECT_EQ(cursor.take(1000)->area, (Rectangle{0, 0, {100, 8}}));
    EXPECT_EQ(cursor.take(15'000)->area, (Rectangle{0, 8, {100, 120}}));
    EXPECT_EQ(cursor.take(100)->area, (Rectangle{0, 128, {20, 4}}));
    EXPECT_EQ(cursor.take(100'000)->area, (Rectangle{20, 128, {80, 4}})) << "the rest of those rows";
    EXPECT_EQ(cursor.take(100'000)->area, (Rectangle{0, 132, {100, 168}}));
    EXPECT_EQ(cursor.take(100'000), std::nullopt);
}

TEST(PartCursorTest, columns_are_shared_out_evenly) {
    PartCursor cursor({{0, {100, 8}, 1}});
    for (const Rectangle& area : {Rectangle{0, 0, {52, 4}}, {52, 0, {48, 4}}, {0, 4, {52, 4}}})
        EXPECT_EQ(cursor.take(390)->area, area);
}

TEST(PartCursorTest, ahead_is_the_largest_next_part) {
    PartCursor cursor({{2, {100, 50}, 1}});
    EXPECT_EQ(cursor.ahead(), (Part{2, 0, {0, 0, {100, 50}}}));
    cursor.take(40);
    EXPECT_EQ(cursor.ahead(), (Part{2, 0, {8, 0, {92, 4}}})) << "100 columns in 13 parts of 8 at most";
}

TEST(PartCursorTest, a_skipped_pass_counts_as_done) {
    PartCursor cursor({{0, {10, 10}, 1}, {1, {10, 10}, 1}, {2, {10, 20}, 1}});
    EXPECT_TRUE(cursor.begins_pass());
    EXPECT_EQ(cursor.share(), 0);
    cursor.leave_out();
    EXPECT_EQ(cursor.share(), 0.25);
    EXPECT_EQ(cursor.take(40)->pass, 1u);
    EXPECT_FALSE(cursor.begins_pass());
    EXPECT_EQ(cursor.share(), 0.35);
    for (; !cursor.begins_pass(); cursor.take(60))
        EXPECT_EQ(cursor.ahead()->pass, 1u);
    EXPECT_EQ(cursor.share(), 0.5);
    cursor.leave_out();
    cursor.leave_out();
    EXPECT_EQ(cursor.share(), 1);
    EXPECT_EQ(cursor.take(1), std::nullopt);
}

TEST(PartCursorTest, the_share_grows_with_each_part) {
    PartCursor cursor(k_areas);
    double before = -1;
    for (; cursor.ahead(); cursor.take(123)) {
        EXPECT_GT(cursor.share(), before);
        before = cursor.share();
    }
    EXPECT_EQ(cursor.share(), 1);
}

TEST(PartCursorTest, an_empty_frame_is_complete) {
    PartCursor cursor({});
    EXPECT_EQ(cursor.ahead(), std::nullopt);
    EXPECT_EQ(cursor.share(), 1);
}

} // namespace tidemark::render::part_cursor_test
