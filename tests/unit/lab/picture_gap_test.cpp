// The difference of two pictures and its words, also for pictures with NaN.
#include "lab/probed_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace tidemark::lab::picture_gap_test {

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_infinity = std::numeric_limits<float>::infinity();

image::Image row(std::initializer_list<float> samples, int channels) {
    image::Image image({int(samples.size()) / channels, 1}, channels, image::SampleType::f32);
    std::ranges::copy(samples, image.f32().begin());
    return image;
}

image::Image grey(std::initializer_list<float> samples) {
    return row(samples, 1);
}
image::Image picture(std::initializer_list<float> samples) {
    return row(samples, 2);
}

TEST(P99Difference, IsInterpolatedBetweenPixels) {
    EXPECT_NEAR(p99_difference(grey({0, 0}), grey({0, 1})), 0.99, 1e-12);
    EXPECT_EQ(p99_difference(grey({2}), grey({1.5f})), 0.5);
}

TEST(P99Difference, FiniteAgainstNonFiniteCountsAs1) {
    EXPECT_EQ(p99_difference(grey({k_nan, k_infinity}), grey({k_nan, k_infinity})), 0);
    EXPECT_EQ(p99_difference(grey({k_nan, 0}), grey({0, k_infinity})), 1);
}

TEST(Alikeness, IsThePsnrOfFinitePixels) {
    EXPECT_EQ(alikeness(picture({0, 0.5f}), picture({0, 0.5f})), "the same");
    EXPECT_EQ(alikeness(picture({0, 0, 0, 0}), picture({0.1f, 0.1f, 0.1f, 0.1f})), "20.0 dB");
}

TEST(Alikeness, CountsNonFinitePixelsAndLeavesThemOut) {
    const image::Image numbers = picture({0, 0, 0, 0, 0, 0});
    EXPECT_EQ(alikeness(numbers, picture({0.1f, 0.1f, k_nan, 0, 0.1f, 0.1f})),
              "0 pixels with NaN or infinity become 1, 20.0 dB over the rest");
    EXPECT_EQ(alikeness(picture({k_nan, k_nan, 0, k_infinity, 0, 0}), numbers),
              "2 pixels with NaN or infinity become 0, the same over the rest");
    EXPECT_EQ(alikeness(numbers, picture({k_nan, 0, k_nan, 0, 0, k_infinity})),
              "0 pixels with NaN or infinity become 3, and no pixel is finite in both");
}

TEST(Alikeness, EqualNanPixelsAreEqual) {
    EXPECT_EQ(alikeness(picture({k_nan, 0, 0, 0}), picture({k_nan, 0, 0.2f, 0})), "20.0 dB");
}

} // namespace tidemark::lab::picture_gap_test
