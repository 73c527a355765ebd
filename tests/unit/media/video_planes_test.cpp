#include "media/file_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace tidemark::image::video_planes_test {

Image row(std::initializer_list<std::array<float, 4>> pixels) {
    Image image({int(pixels.size()), 1}, 4, SampleType::f32);
    auto to = image.f32().begin();
    for (const auto& pixel : pixels)
        to = std::ranges::copy(pixel, to).out;
    return image;
}

std::vector<int> codes(const Image& image, bool alpha) {
    const std::vector<uint16_t> planes = ten_bit_planes(image, alpha);
    return {planes.begin(), planes.end()};
}

/// By hand: of pure red luma is 0.2126, Cb -0.2126 / 1.8556, Cr 0.5; of blue 0.0722, 0.5, -0.0722 / 1.5748.
TEST(VideoPlanes, are_bt709_in_limited_range) {
    const Image image = row({{0, 0, 0, 1}, {1, 1, 1, 1}, {1, 0, 0, 0}, {0, 0, 1, 0.5f}});
    EXPECT_EQ(codes(image, false), (std::vector{64, 940, 250, 127, 512, 512, 409, 960, 512, 512, 960, 471}));
    EXPECT_EQ(codes(image, true), (std::vector{64, 940, 250, 127, 512, 512, 409, 960, 512, 512, 960, 471, //
                                               1023, 1023, 0, 512}));
}

TEST(VideoPlanes, are_clamped_to_the_display_range) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(codes(row({{nan, nan, nan, nan}, {2, infinity, 9, 3}, {-1, -infinity, -2, -1}}), true),
              (std::vector{64, 940, 64, 512, 512, 512, 512, 512, 512, 0, 1023, 0}));
}

TEST(VideoPlanes, of_bytes_start_at_the_top_row) {
    Image image({1, 2}, 4, SampleType::u8);
    std::ranges::copy(std::array<uint8_t, 8>{255, 255, 255, 255, 51, 51, 51, 255}, image.u8().begin());
    EXPECT_EQ(codes(image, false), (std::vector{239, 940, 512, 512, 512, 512})); // 64 + 876 / 5
}

TEST(VideoPlanes, of_16_bit_samples_are_equal) {
    Image drawn({65536, 1}, 4, SampleType::f32), stored = drawn;
    for (size_t i = 0; i < drawn.samples(); ++i) {
        const auto word = uint16_t(2654435761u * uint32_t(i) >> 16);
        stored.f32()[i] = float(word) / 65535.0f;
        drawn.f32()[i] = float((double(word) + 0.4 * double(i % 3) - 0.4) / 65535);
    }
    EXPECT_EQ(ten_bit_planes(drawn, true), ten_bit_planes(stored, true));
}

TEST(VideoPlanes, distinguish_more_than_256_levels) {
    Image ramp({4096, 1}, 4, SampleType::f32);
    for (size_t x = 0; x < 4096; ++x)
        std::fill_n(ramp.f32().begin() + long(4 * x), 3, float(x) / 4095);
    std::vector<int> luma = codes(ramp, false);
    luma.resize(4096);
    EXPECT_TRUE(std::ranges::is_sorted(luma));
    EXPECT_EQ(std::unique(luma.begin(), luma.end()) - luma.begin(), 877); // 64 to 940
}

} // namespace tidemark::image::video_planes_test
