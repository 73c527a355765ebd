#include "media/file_samples.hpp"
#include "picture_support.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace tidemark::image::file_samples_test {

template <class Sample>
std::vector<Sample> samples_of(const std::vector<std::byte>& bytes) {
    std::vector<Sample> samples(bytes.size() / sizeof(Sample));
    std::memcpy(samples.data(), bytes.data(), bytes.size());
    return samples;
}

Image all_bytes() {
    Image image({256, 1}, 1, SampleType::u8);
    for (size_t i = 0; i < 256; ++i)
        image.u8()[i] = uint8_t(i);
    return image;
}

Image grey(std::initializer_list<float> values) {
    Image image({int(values.size()), 1}, 1, SampleType::f32);
    std::ranges::copy(values, image.f32().begin());
    return image;
}

TEST(FileSamples, a_byte_becomes_the_same_fraction_of_any_depth) {
    const auto words = samples_of<uint16_t>(file_samples(all_bytes(), SampleDepth::u16));
    const auto floats = samples_of<float>(file_samples(all_bytes(), SampleDepth::f32));
    ASSERT_EQ(words.size(), 256u);
    ASSERT_EQ(floats.size(), 256u);
    for (unsigned v = 0; v < 256; ++v) {
        EXPECT_EQ(words[v] * 255u, v * 65535u);
        EXPECT_EQ(floats[v], float(double(v) / 255.0));
    }
    EXPECT_EQ(file_samples(all_bytes(), SampleDepth::half), file_samples(all_bytes(), SampleDepth::f32));
    EXPECT_EQ(file_samples(all_bytes(), SampleDepth::u8), all_bytes().bytes);
}

TEST(FileSamples, every_integer_survives_conversion_to_float) {
    Image image({65536, 1}, 1, SampleType::f32);
    for (size_t i = 0; i < 65536; ++i)
        image.f32()[i] = float(i) / 65535.0f;
    const auto words = samples_of<uint16_t>(file_samples(image, SampleDepth::u16));
    for (size_t i = 0; i < 65536; ++i)
        ASSERT_EQ(words[i], i);
    for (size_t i = 0; i < 256; ++i)
        image.f32()[i] = float(i) / 255.0f;
    const auto bytes = samples_of<uint8_t>(file_samples(image, SampleDepth::u8));
    for (size_t i = 0; i < 256; ++i)
        ASSERT_EQ(bytes[i], i);
}

TEST(FileSamples, floats_are_clamped_and_rounded_to_nearest_and_nan_is_zero) {
    constexpr float inf = std::numeric_limits<float>::infinity(),
                    nan = std::numeric_limits<float>::quiet_NaN();
    const Image image = grey({nan, -nan, -inf, -1.0f, -0.0f, 0.0f, 1.0f, 1.5f, inf, 0x1p-149f, 0.5f / 255.0f,
                              std::nextafter(0.5f / 255.0f, 0.0f), 254.4f / 255.0f, 254.6f / 255.0f});
    EXPECT_EQ(samples_of<uint8_t>(file_samples(image, SampleDepth::u8)),
              (std::vector<uint8_t>{0, 0, 0, 0, 0, 0, 255, 255, 255, 0, 1, 0, 254, 255}));
    const auto words = samples_of<uint16_t>(file_samples(image, SampleDepth::u16));
    EXPECT_EQ(std::vector<uint16_t>(words.begin(), words.begin() + 9),
              (std::vector<uint16_t>{0, 0, 0, 0, 0, 0, 65535, 65535, 65535}));
}

TEST(FileSamples, floats_to_floats_are_the_same_bytes) {
    const Image image = patterned_f32({4, 4}, 4);
    EXPECT_EQ(file_samples(image, SampleDepth::f32), image.bytes);
}

TEST(FileSamples, radiance_gets_three_clamped_channels) {
    constexpr float inf = std::numeric_limits<float>::infinity(),
                    nan = std::numeric_limits<float>::quiet_NaN();
    const Image repeated = radiance_samples(grey({0.25f, -1.0f, nan, inf}));
    EXPECT_EQ(repeated.channels, 3);
    EXPECT_EQ(
        std::vector<float>(repeated.f32().begin(), repeated.f32().end()),
        (std::vector<float>{0.25f, 0.25f, 0.25f, 0, 0, 0, 0, 0, 0, 0x1.fep126f, 0x1.fep126f, 0x1.fep126f}));
    const Image image = patterned_u8({2, 2}, 4);
    const Image colours = radiance_samples(image);
    for (size_t pixel = 0; pixel < 4; ++pixel)
        for (size_t channel = 0; channel < 3; ++channel)
            EXPECT_EQ(colours.f32()[3 * pixel + channel], float(image.u8()[4 * pixel + channel]) / 255.0f);
}

TEST(WithChannels, grey_is_repeated_and_a_missing_alpha_is_1) {
    Image bytes({2, 1}, 1, SampleType::u8);
    std::ranges::copy(std::array<uint8_t, 2>{51, 204}, bytes.u8().begin());
    const auto in_bytes = [](const Image& image) {
        return std::vector<int>(image.u8().begin(), image.u8().end());
    };
    EXPECT_EQ(with_channels(bytes, 1), bytes);
    EXPECT_EQ(in_bytes(with_channels(bytes, 2)), (std::vector{51, 255, 204, 255}));
    EXPECT_EQ(in_bytes(with_channels(bytes, 3)), (std::vector{51, 51, 51, 204, 204, 204}));
    EXPECT_EQ(in_bytes(with_channels(bytes, 4)), (std::vector{51, 51, 51, 255, 204, 204, 204, 255}));
    Image translucent({1, 1}, 2, SampleType::f32);
    std::ranges::copy(std::array{0.5F, 0.25F}, translucent.f32().begin());
    const Image wide = with_channels(translucent, 4);
    EXPECT_EQ(std::vector<float>(wide.f32().begin(), wide.f32().end()),
              (std::vector{0.5F, 0.5F, 0.5F, 0.25F}));
    Image colour({1, 1}, 3, SampleType::f32);
    std::ranges::copy(std::array{1.0F, 2.0F, -3.0F}, colour.f32().begin());
    const Image opaque = with_channels(colour, 4);
    EXPECT_EQ(std::vector<float>(opaque.f32().begin(), opaque.f32().end()),
              (std::vector{1.0F, 2.0F, -3.0F, 1.0F}));
}

} // namespace tidemark::image::file_samples_test
