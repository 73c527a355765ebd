// The difference that 99 % of the pixels stay below, by hand.
#include "lab/check/picture_gap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace tidemark::lab {
namespace {

image::Image picture(std::initializer_list<float> samples) {
    image::Image image({int(samples.size()), 1}, 1, image::SampleType::f32);
    std::ranges::copy(samples, image.f32().begin());
    return image;
}

TEST(P99Difference, LiesBetweenTheTwoPixelsAroundIt) {
    EXPECT_NEAR(p99_difference(picture({0, 0}), picture({0, 1})), 0.99, 1e-12);
    EXPECT_EQ(p99_difference(picture({2}), picture({1.5f})), 0.5);
}

TEST(P99Difference, WhatIsANumberInOneOnlyCountsAsOne) {
    using Limits = std::numeric_limits<float>;
    const float infinity = Limits::infinity(), nan = Limits::quiet_NaN();
    EXPECT_EQ(p99_difference(picture({nan, infinity}), picture({nan, infinity})), 0);
    EXPECT_EQ(p99_difference(picture({nan, 0}), picture({0, infinity})), 1);
}

} // namespace
} // namespace tidemark::lab
