#include "media/image.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace tidemark::image::light_mean_test {

Image pixel(float r, float g, float b, float a) {
    Image image({1, 1}, 4, SampleType::f32);
    std::ranges::copy(std::array{r, g, b, a}, image.f32().begin());
    return image;
}

std::vector<float> mean_of(bool clamped, const std::vector<Image>& pictures) {
    LightMean mean(clamped);
    for (const Image& picture : pictures)
        mean.add(picture);
    Image result({1, 1}, 4, SampleType::f32);
    mean.take(result);
    return {result.f32().begin(), result.f32().end()};
}

/// IEC 61966-2-1: half the light of white is the sample 0.7354.
TEST(LightMean, averages_linear_light) {
    const auto half = mean_of(true, {pixel(1, 0, 0.5f, 1), pixel(0, 0, 0.5f, 1)});
    EXPECT_NEAR(half[0], 0.735357, 1e-6);
    EXPECT_EQ(half[1], 0);
    EXPECT_NEAR(half[2], 0.5, 1e-7);
    EXPECT_EQ(half[3], 1);
}

TEST(LightMean, colours_are_weighted_by_coverage) {
    const auto edge = mean_of(true, {pixel(1, 0, 0.5f, 1), pixel(0, 1, 0, 0)});
    EXPECT_EQ(edge, (std::vector<float>{1, 0, edge[2], 0.5f})); // alpha is not light
    EXPECT_NEAR(edge[2], 0.5, 1e-7);
    EXPECT_NEAR(mean_of(true, {pixel(1, 0, 0, 0.75f), pixel(0, 0, 0, 0.25f)})[0], srgb_of_light(0.75), 1e-6);
    EXPECT_EQ(mean_of(true, {pixel(1, 1, 1, 0), pixel(1, 1, 1, 0)}), (std::vector<float>{0, 0, 0, 0}));
}

TEST(LightMean, display_values_are_clamped_sample_by_sample) {
    EXPECT_NEAR(mean_of(true, {pixel(9, -3, 0, 1), pixel(0, 0, 0, 1)})[0], 0.735357, 1e-6);
    EXPECT_GT(mean_of(false, {pixel(9, -3, 0, 1), pixel(0, 0, 0, 1)})[0], 5);
    EXPECT_LT(mean_of(false, {pixel(9, -3, 0, 1), pixel(0, 0, 0, 1)})[1], -2);
}

TEST(LightMean, keeps_non_finite_values) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    const auto mean = mean_of(true, {pixel(nan, infinity, 0, 1), pixel(0, 0, 0, 1)});
    EXPECT_TRUE(std::isnan(mean[0]));
    EXPECT_TRUE(std::isinf(mean[1]));
    EXPECT_TRUE(std::isnan(mean_of(true, {pixel(nan, 0, 0, 0)})[0]));
}

TEST(Transfer, inverse_returns_the_sample) {
    for (double sample = -2; sample < 3; sample += 0.01)
        EXPECT_NEAR(srgb_of_light(light_of_srgb(sample)), sample, 1e-4); // the standard's halves meet to 3e-5
    EXPECT_EQ(light_of_srgb(1), 1);
    EXPECT_NEAR(light_of_srgb(0.5), 0.214041, 1e-6);
}

} // namespace tidemark::image::light_mean_test
