// The difference of two pictures and its words, also for pictures with NaN.
#include "lab/probed_pictures.hpp"
#include "lab/simplify.hpp"

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

/// Returns a black picture with a white rectangle of that width and height at the column.
image::Image black_with(int column, int width, int height) {
    image::Image image({160, 90}, 3, image::SampleType::f32);
    for (int y = 40; y < 40 + height; ++y)
        for (int x = column; x < column + width; ++x)
            for (int k = 0; k < 3; ++k)
                image.f32()[size_t((y * 160 + x) * 3 + k)] = 1;
    return image;
}

TEST(Parts, AnEdgeMayMoveByOnePixel) {
    const Goal goal{Measure::rmse, 0.01, {}};
    EXPECT_TRUE(keeps_parts(goal, black_with(50, 30, 30), black_with(51, 30, 30)));
    EXPECT_FALSE(keeps_parts(goal, black_with(50, 30, 30), black_with(53, 30, 30)));
}

TEST(Parts, ASmallObjectMayNotVanishOrAppear) {
    const Goal goal{Measure::rmse, 0.01, {}};
    const image::Image none = black_with(50, 0, 0), line = black_with(50, 1, 5), dot = black_with(50, 1, 1);
    EXPECT_FALSE(keeps_parts(goal, line, none));
    EXPECT_FALSE(keeps_parts(goal, dot, none));
    EXPECT_FALSE(keeps_parts(goal, none, dot));
    EXPECT_FALSE(keeps_parts(goal, black_with(50, 20, 20), none));
}

glsl::Wrap wrap_of(int first, int last, bool replaces) {
    const auto word = [](int column) { return glsl::WrittenWord{{"a.glsl", 1, column}, "x"}; };
    return {word(first), word(last), "", "", replaces};
}

TEST(CutInside, TextThatIsReplacedHoldsNoOtherCut) {
    const glsl::Cure outer{{wrap_of(1, 9, true)}, ""}, inner{{wrap_of(3, 5, true)}, ""};
    EXPECT_TRUE(is_inside(inner, outer));
    EXPECT_FALSE(is_inside(outer, inner));
    EXPECT_TRUE(is_inside(outer, outer)) << "only one of two can replace the same tokens";
}

TEST(CutInside, TextWithSomethingAroundMayBeChangedToo) {
    const glsl::Cure exit{{wrap_of(1, 9, false)}, ""}, other_exit = exit, number{{wrap_of(3, 3, true)}, ""};
    EXPECT_FALSE(is_inside(number, exit));
    EXPECT_FALSE(is_inside(exit, other_exit));
}

TEST(CutInside, ExitsThatReplaceTheSameCallExcludeEachOther) {
    const glsl::Cure one{{wrap_of(3, 5, true), wrap_of(1, 9, false)}, ""}, other = one;
    EXPECT_TRUE(is_inside(one, other));
}

} // namespace tidemark::lab::picture_gap_test
