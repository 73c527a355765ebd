#include "window/frame_pump.hpp"

#include <gmock/gmock.h>

namespace tidemark::window::frame_pace_test {

using Way = FramePace::Way;
constexpr Extent k_extent{100, 100};

TEST(FramePaceTest, a_frame_of_unknown_cost_is_drawn_in_parts) {
    FramePace pace;
    EXPECT_EQ(pace.way(k_extent), Way::in_parts);
    EXPECT_EQ(pace.expected(k_extent), std::nullopt);
    pace.took(k_extent, Way::in_parts, 0.001);
    EXPECT_DOUBLE_EQ(*pace.expected({200, 100}), 0.002);
    EXPECT_EQ(pace.way(k_extent), Way::whole);
    pace.doubt();
    EXPECT_EQ(pace.way(k_extent), Way::in_parts);
}

TEST(FramePaceTest, a_slow_frame_is_the_last_one_drawn_whole) {
    FramePace pace;
    pace.took(k_extent, Way::whole, 0.04);
    EXPECT_EQ(pace.way(k_extent), Way::whole);
    pace.took(k_extent, Way::whole, 0.06);
    EXPECT_EQ(pace.way(k_extent), Way::in_parts);
}

TEST(FramePaceTest, between_the_thresholds_the_mode_is_kept) {
    FramePace pace;
    pace.took(k_extent, Way::in_parts, 0.04);
    EXPECT_EQ(pace.way(k_extent), Way::in_parts);
    pace.took(k_extent, Way::in_parts, 0.02);
    EXPECT_EQ(pace.way(k_extent), Way::whole);
    pace.took(k_extent, Way::whole, 0.04);
    EXPECT_EQ(pace.way(k_extent), Way::whole);
}

TEST(FramePaceTest, more_pixels_take_longer) {
    FramePace pace;
    pace.took(k_extent, Way::in_parts, 0.02);
    EXPECT_EQ(pace.way({200, 200}), Way::in_parts);
    EXPECT_EQ(pace.way({50, 50}), Way::whole);
    pace.took({0, 0}, Way::in_parts, 1);
    EXPECT_EQ(pace.way(k_extent), Way::whole) << "nothing is known of a picture without pixels";
}

} // namespace tidemark::window::frame_pace_test
