#include "media/comparison.hpp"
#include "picture_support.hpp"

#include <cmath>
#include <limits>

namespace tidemark::image::metrics_test {

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_inf = std::numeric_limits<float>::infinity();

Image grey(std::initializer_list<float> values) {
    Image image({int(values.size()), 1}, 1, SampleType::f32);
    std::ranges::copy(values, image.f32().begin());
    return image;
}

TEST(Metrics, equal_pictures_have_no_difference_and_infinite_psnr) {
    for (const Image& image : {patterned_u8({7, 5}, 3), patterned_f32({7, 5}, 4)}) {
        const auto found = compare(image, image);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->largest, 0.0);
        EXPECT_EQ(found->rmse, 0.0);
        EXPECT_EQ(found->psnr, std::numeric_limits<double>::infinity());
        EXPECT_TRUE(found->equal());
        EXPECT_EQ(found->differing_share(), 0.0);
        EXPECT_EQ(found->pixels, 35u);
    }
}

TEST(Metrics, difference_of_one_byte_step_is_one_255th) {
    Image left({2, 2}, 3, SampleType::u8), right = left;
    left.u8()[4] = 200; // pixel 1
    right.u8()[4] = 201;
    const auto found = compare(left, right);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->largest, 1.0 / 255.0);
    EXPECT_DOUBLE_EQ(found->rmse, std::sqrt(1.0 / 255.0 / 255.0 / 12.0));
    EXPECT_EQ(found->differing, 1u);
    EXPECT_EQ(found->differing_share(), 0.25);
    EXPECT_FALSE(found->equal());
}

TEST(Metrics, psnr_has_a_peak_of_1) {
    const auto found = compare(grey({0.5f, 0.5f}), grey({0.25f, 0.75f}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->rmse, 0.25);
    EXPECT_DOUBLE_EQ(found->psnr, 20.0 * std::log10(4.0));
    const auto black_white = compare(grey({0.0f}), grey({1.0f}));
    ASSERT_TRUE(black_white);
    EXPECT_EQ(black_white->psnr, 0.0);
}

TEST(Metrics, a_pixel_differs_once_however_many_of_its_samples_do) {
    Image left({3, 1}, 4, SampleType::u8), right = left;
    for (const size_t sample : {4, 5, 6, 7})
        right.u8()[sample] = 9;
    EXPECT_EQ(compare(left, right)->differing, 1u);
}

TEST(Metrics, a_byte_equals_its_float_in_a_file) {
    Image bytes({256, 1}, 1, SampleType::u8), floats({256, 1}, 1, SampleType::f32);
    for (size_t i = 0; i < 256; ++i) {
        bytes.u8()[i] = uint8_t(i);
        floats.f32()[i] = float(i) / 255.0f;
    }
    EXPECT_TRUE(compare(bytes, floats)->equal());
    EXPECT_TRUE(compare(floats, bytes)->equal());
    floats.f32()[3] = 0.5f;
    const auto found = compare(bytes, floats);
    EXPECT_EQ(found->largest, 0.5 - double(3.0f / 255.0f));
    EXPECT_EQ(found->rmse, compare(floats, bytes)->rmse);
}

TEST(Metrics, nan_equals_nan_and_infinity_equals_infinity) {
    const auto found = compare(grey({k_nan, k_inf, -k_inf, 1.0f}), grey({-k_nan, k_inf, -k_inf, 1.0f}));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->equal());
    EXPECT_EQ(found->rmse, 0.0);
    EXPECT_EQ(found->both_non_finite, 3u);
    EXPECT_EQ(found->one_non_finite, 0u);
}

TEST(Metrics, other_non_finite_pairs_make_the_mean_nan_and_keep_the_maximum) {
    for (const auto& [left, right] : {std::pair{k_nan, 0.0f},
                                      {0.0f, k_nan},
                                      {k_inf, 0.0f},
                                      {k_inf, k_nan},
                                      {k_inf, -k_inf},
                                      {0.0f, -k_inf}}) {
        const auto found = compare(grey({0.0f, left, 1.0f}), grey({0.0f, right, 0.75f}));
        ASSERT_TRUE(found);
        EXPECT_TRUE(std::isnan(found->rmse));
        EXPECT_TRUE(std::isnan(found->psnr));
        EXPECT_FALSE(found->psnr > 30.0);
        EXPECT_EQ(found->largest, 0.25);
        EXPECT_EQ(found->differing, 2u);
        const bool both = !std::isfinite(left) && !std::isfinite(right);
        EXPECT_EQ(found->one_non_finite, both ? 0u : 1u);
        EXPECT_EQ(found->both_non_finite, both ? 1u : 0u);
    }
}

TEST(Metrics, the_sign_of_zero_is_ignored) {
    EXPECT_TRUE(compare(grey({0.0f}), grey({-0.0f}))->equal());
}

TEST(Metrics, the_smallest_float_difference_counts) {
    const auto found = compare(grey({0.0f}), grey({0x1p-149f}));
    EXPECT_EQ(found->differing, 1u);
    EXPECT_EQ(found->largest, 0x1p-149);
    EXPECT_EQ(found->rmse, 0x1p-149);
}

TEST(Metrics, pictures_of_different_shape_are_not_compared) {
    const auto sizes = compare(Image({640, 360}, 3, SampleType::u8), Image({64, 36}, 3, SampleType::u8));
    ASSERT_FALSE(sizes);
    EXPECT_EQ(sizes.error().code, ErrorCode::check_failed);
    EXPECT_EQ(
        sizes.error().message,
        "the pictures cannot be compared: one is 640x360 with 3 channels, the other 64x36 with 3 channels");
    const auto channels = compare(Image({4, 4}, 4, SampleType::u8), Image({4, 4}, 1, SampleType::f32));
    ASSERT_FALSE(channels);
    EXPECT_EQ(channels.error().message,
              "the pictures cannot be compared: one is 4x4 with 4 channels, the other 4x4 with 1 channel");
}

} // namespace tidemark::image::metrics_test
