#include "render/exposure.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace tidemark::render::exposure_test {

TEST(Expose, one_sample_equals_the_frame) {
    const ExposedFrame frame = expose({}, FrameState{.frame = 30});
    ASSERT_EQ(frame.samples.size(), 1u);
    EXPECT_EQ(frame.samples[0].x, 0);
    EXPECT_EQ(frame.samples[0].y, 0);
    EXPECT_EQ(frame.samples[0].inputs.time, 0.5);
    EXPECT_FALSE(frame.moving);
}

TEST(Expose, samples_stay_within_a_pixel_and_their_mean_is_its_middle) {
    for (const int count : {2, 3, 16, 64, 1000}) {
        const ExposedFrame frame = expose({.samples = count}, {});
        double x = 0, y = 0;
        for (const Sample& sample : frame.samples) {
            EXPECT_LT(std::abs(sample.x), 0.75) << count;
            EXPECT_LT(std::abs(sample.y), 0.75) << count;
            x += sample.x;
            y += sample.y;
        }
        EXPECT_NEAR(x, 0, 1e-9);
        EXPECT_NEAR(y, 0, 1e-9);
    }
}

/// Each strip of a pixel, across or upright, holds its share of 64 samples: an eighth of them in 1/8.
TEST(Expose, samples_lie_evenly_along_both_axes) {
    std::vector<int> columns(8), rows(8);
    for (const Sample& sample : expose({.samples = 64}, {}).samples) {
        ++columns[size_t(std::clamp(int(8 * (sample.x + 0.5)), 0, 7))];
        ++rows[size_t(std::clamp(int(8 * (sample.y + 0.5)), 0, 7))];
    }
    EXPECT_THAT(columns, ::testing::Each(8));
    EXPECT_THAT(rows, ::testing::Each(::testing::AllOf(::testing::Ge(6), ::testing::Le(10))));
}

TEST(Expose, the_shutter_opens_at_the_frames_time) {
    const ExposedFrame frame = expose({.samples = 4, .shutter = 0.5}, FrameState{.frame = 10, .fps = 10});
    EXPECT_TRUE(frame.moving);
    EXPECT_NEAR(frame.samples.front().inputs.time, 1.00625, 1e-12);
    EXPECT_NEAR(frame.samples.back().inputs.time, 1.04375, 1e-12);
    EXPECT_EQ(frame.samples.back().inputs.frame, 10);
}

} // namespace tidemark::render::exposure_test
