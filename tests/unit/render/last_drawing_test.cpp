#include "render/pass_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tidemark::render::last_drawing_test {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

PassInputs reads(double number, std::vector<Generation> channels = {}) {
    return {{UniformNumbers{number}}, std::move(channels)};
}

LastDrawing drawn_from(PassInputs inputs, Generation generation) {
    LastDrawing last;
    last.drew(std::move(inputs), generation);
    return last;
}

TEST(LastDrawing, holds_nothing_before_the_first_frame) {
    EXPECT_FALSE(LastDrawing().holds({}, 0));
    EXPECT_FALSE(LastDrawing().holds(reads(1), 0));
}

TEST(LastDrawing, a_pass_without_inputs_is_drawn_once) {
    EXPECT_TRUE(drawn_from({}, 1).holds({}, 1));
}

TEST(LastDrawing, holds_while_uniforms_and_channels_are_the_same) {
    const LastDrawing last = drawn_from(reads(1.5, {3, 7}), 4);
    EXPECT_TRUE(last.holds(reads(1.5, {3, 7}), 4));
    EXPECT_FALSE(last.holds(reads(std::nextafter(1.5, 2), {3, 7}), 4));
    EXPECT_FALSE(last.holds(reads(1.5, {3, 8}), 4));
    EXPECT_FALSE(last.holds(reads(1.5, {4, 7}), 4));
}

TEST(LastDrawing, a_cleared_or_recreated_target_holds_nothing) {
    EXPECT_FALSE(drawn_from(reads(1), 4).holds(reads(1), 5));
}

TEST(LastDrawing, a_pass_that_reads_itself_is_always_redrawn) {
    // It reads generation 4 of its own target and makes generation 5, which it reads next.
    EXPECT_FALSE(drawn_from(reads(1, {4}), 5).holds(reads(1, {5}), 5));
}

TEST(LastDrawing, nan_is_compared_by_its_bits) {
    EXPECT_TRUE(drawn_from(reads(k_nan), 1).holds(reads(k_nan), 1));
    EXPECT_FALSE(drawn_from(reads(k_nan), 1).holds(reads(-k_nan), 1));
    EXPECT_FALSE(drawn_from(reads(k_nan), 1).holds(reads(0), 1));
}

TEST(LastDrawing, the_sign_of_zero_counts) {
    EXPECT_TRUE(drawn_from(reads(-0.0), 1).holds(reads(-0.0), 1));
    EXPECT_FALSE(drawn_from(reads(0.0), 1).holds(reads(-0.0), 1)); // 1 / x tells them apart
}

TEST(LastDrawing, numbers_are_compared_individually) {
    const PassInputs two{{UniformNumbers{1, 2}}, {}};
    EXPECT_FALSE(drawn_from(two, 1).holds({{UniformNumbers{1, 3}}, {}}, 1));
    EXPECT_FALSE(drawn_from(two, 1).holds(reads(1), 1));
    EXPECT_FALSE(drawn_from(two, 1).holds({{UniformNumbers{1}, UniformNumbers{2}}, {}}, 1));
}

} // namespace tidemark::render::last_drawing_test
