#include "media/generated_textures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::image::noise_kinds_test {

/// A sample in the row order of a file.
uint8_t in_file(const Image& image, int x, int y, int channel = 0) {
    const int side = image.extent.width;
    return image.u8()[size_t(((side - 1 - y) * side + x) * image.channels + channel)];
}

std::vector<double> plane_of(const Image& image, int channel) {
    std::vector<double> plane;
    for (auto i = size_t(channel); i < image.samples(); i += size_t(image.channels))
        plane.push_back(image.u8()[i]);
    return plane;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double sum_ab = 0.0, sum_aa = 0.0, sum_bb = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        sum_ab += (a[i] - 127.5) * (b[i] - 127.5);
        sum_aa += (a[i] - 127.5) * (a[i] - 127.5);
        sum_bb += (b[i] - 127.5) * (b[i] - 127.5);
    }
    return sum_ab / std::sqrt(sum_aa * sum_bb);
}

double chi_squared(const std::vector<double>& plane) {
    std::array<double, 256> counts{};
    for (const double value : plane)
        ++counts[size_t(value)];
    const double expected = double(plane.size()) / 256.0;
    double sum = 0.0;
    for (const double count : counts)
        sum += (count - expected) * (count - expected) / expected;
    return sum;
}

constexpr int k_tile = 128;

/// The discrete Fourier transform along the rows, transposed.
std::vector<std::complex<double>> transformed_rows(const std::vector<std::complex<double>>& from) {
    std::vector<std::complex<double>> turns;
    for (int i = 0; i < k_tile; ++i)
        turns.push_back(std::polar(1.0, -2.0 * std::numbers::pi * i / k_tile));
    std::vector<std::complex<double>> to(from.size());
    for (int y = 0; y < k_tile; ++y)
        for (int k = 0; k < k_tile; ++k) {
            std::complex<double> sum = 0.0;
            for (int x = 0; x < k_tile; ++x)
                sum += from[size_t(y * k_tile + x)] * turns[size_t(x * k % k_tile)];
            to[size_t(k * k_tile + y)] = sum;
        }
    return to;
}

/// Mean power of the frequencies with `from` <= radius < `to` cycles a texel; white noise of uniform bytes
/// has 1 everywhere.
class PowerSpectrum {
public:
    /// Takes the first k_tile² texels of a picture.
    PowerSpectrum(const Image& image, int channel) {
        std::vector<std::complex<double>> tile;
        for (int y = 0; y < k_tile; ++y)
            for (int x = 0; x < k_tile; ++x)
                tile.emplace_back(in_file(image, x, y, channel) / 255.0 - 0.5);
        const double scale = (65535.0 / 12.0) / (255.0 * 255.0) * k_tile * k_tile;
        for (const std::complex<double>& value : transformed_rows(transformed_rows(tile)))
            power_.push_back(std::norm(value) / scale);
    }

    double mean(double from, double to) const {
        double sum = 0.0;
        int count = 0;
        for (int y = 0; y < k_tile; ++y)
            for (int x = 0; x < k_tile; ++x) {
                const double radius = std::hypot(std::min(x, k_tile - x), std::min(y, k_tile - y)) / k_tile;
                if (radius == 0.0 || radius < from || radius >= to)
                    continue;
                sum += power_[size_t(y * k_tile + x)];
                ++count;
            }
        return sum / count;
    }

private:
    std::vector<double> power_;
};

/// Made once: under the sanitizers it takes a second.
const Image& blue_noise() {
    static const Image noise = make_noise(NoiseTexture::blue_1024);
    return noise;
}

TEST(NoiseKinds, have_the_shapes_of_shadertoys_textures) {
    const auto expect = [](NoiseTexture kind, int side, int channels) {
        const Image image = make_noise(kind);
        EXPECT_EQ(image.extent, (Extent{side, side}));
        EXPECT_EQ(image.channels, channels);
        EXPECT_EQ(image.type, SampleType::u8);
        EXPECT_EQ(image.bytes.size(), size_t(side * side * channels));
    };
    expect(NoiseTexture::rgba_256, 256, 4);
    expect(NoiseTexture::rgba_64, 64, 4);
    expect(NoiseTexture::grey_256, 256, 1);
    expect(NoiseTexture::grey_64, 64, 1);
    expect(NoiseTexture::blue_1024, 1024, 4);
    expect(NoiseTexture::bayer_8, 8, 1);
}

TEST(NoiseKinds, rgba_256_is_the_default_noise) {
    EXPECT_EQ(make_noise(NoiseTexture::rgba_256), make_noise());
    EXPECT_EQ(make_noise(NoiseTexture::rgba_256, 5), make_noise(5));
}

TEST(NoiseKinds, alpha_of_rgba_64_is_the_blue_of_the_next_texel_and_rows_are_chained) {
    const Image noise = make_noise(NoiseTexture::rgba_64);
    for (int i = 0; i < 64 * 64; ++i) {
        const int next = (i + 1) % (64 * 64);
        ASSERT_EQ(in_file(noise, i % 64, i / 64, 3), in_file(noise, next % 64, next / 64, 2)) << i;
    }
}

TEST(NoiseKinds, red_green_and_blue_of_rgba_64_are_independent) {
    const Image noise = make_noise(NoiseTexture::rgba_64);
    for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}})
        for (int dy = 0; dy < 64; dy += 3)
            for (int dx = 0; dx < 64; dx += 3) {
                std::vector<double> moved;
                for (int y = 0; y < 64; ++y)
                    for (int x = 0; x < 64; ++x)
                        moved.push_back(noise.u8()[size_t(4 * ((y + dy) % 64 * 64 + (x + dx) % 64) + b)]);
                // six standard deviations
                ASSERT_LT(std::abs(correlation(plane_of(noise, a), moved)), 6.0 / 64.0) << dx << ' ' << dy;
            }
}

TEST(NoiseKinds, bytes_are_uniform) {
    for (const NoiseTexture kind : {NoiseTexture::rgba_64, NoiseTexture::grey_64, NoiseTexture::grey_256})
        for (int channel = 0; channel < make_noise(kind).channels; ++channel)
            EXPECT_NEAR(chi_squared(plane_of(make_noise(kind), channel)), 255.0, 4.0 * 22.6);
}

TEST(NoiseKinds, grey_256_is_independent_of_red) {
    const std::vector<double> grey = plane_of(make_noise(NoiseTexture::grey_256), 0);
    for (int channel = 0; channel < 4; ++channel)
        EXPECT_LT(std::abs(correlation(grey, plane_of(make_noise(), channel))), 5.0 / 256.0);
}

TEST(NoiseKinds, bayer_has_the_standard_order) {
    constexpr std::array<int, 64> order = {0,  32, 8,  40, 2,  34, 10, 42, 48, 16, 56, 24, 50, 18, 58, 26,
                                           12, 44, 4,  36, 14, 46, 6,  38, 60, 28, 52, 20, 62, 30, 54, 22,
                                           3,  35, 11, 43, 1,  33, 9,  41, 51, 19, 59, 27, 49, 17, 57, 25,
                                           15, 47, 7,  39, 13, 45, 5,  37, 63, 31, 55, 23, 61, 29, 53, 21};
    const Image bayer = make_noise(NoiseTexture::bayer_8);
    for (int i = 0; i < 64; ++i)
        EXPECT_EQ(in_file(bayer, i % 8, i / 8), 4 * order[size_t(i)] + 2) << i;
    EXPECT_EQ(bayer, make_noise(NoiseTexture::bayer_8, 7));
}

TEST(NoiseKinds, blue_noise_has_every_byte_equally_often) {
    const Image& noise = blue_noise();
    for (int channel = 0; channel < 4; ++channel)
        EXPECT_EQ(chi_squared(plane_of(noise, channel)), 0.0);
}

TEST(NoiseKinds, blue_noise_repeats_after_128_texels) {
    const Image& noise = blue_noise();
    for (int y = 0; y < 1024; ++y)
        for (int x = 0; x < 1024; ++x)
            ASSERT_EQ(in_file(noise, x, y), in_file(noise, x % 128, y % 128));
}

TEST(NoiseKinds, blue_noise_has_its_power_in_the_high_frequencies) {
    const Image& noise = blue_noise();
    const PowerSpectrum white(make_noise(NoiseTexture::grey_256), 0);
    EXPECT_NEAR(white.mean(0.0, 0.1), 1.0, 0.2);
    for (int channel = 0; channel < 4; ++channel) {
        const PowerSpectrum blue(noise, channel);
        for (const auto& [from, to] : {std::pair{0.0, 0.1}, {0.1, 0.2}, {0.2, 0.3}, {0.3, 0.4}, {0.4, 0.5}})
            RecordProperty("channel_" + std::to_string(channel) + "_from_" + std::to_string(from),
                           std::to_string(blue.mean(from, to)));
        EXPECT_LT(blue.mean(0.0, 0.1), 0.001 * white.mean(0.0, 0.1));
        EXPECT_LT(blue.mean(0.1, 0.2), 0.01 * white.mean(0.1, 0.2));
        EXPECT_GT(blue.mean(0.4, 0.72), 1.3 * white.mean(0.4, 0.72));
        // No lattice: the strongest ring of one texel's width is not a peak
        for (double radius = 0.3; radius < 0.7; radius += 0.02)
            EXPECT_LT(blue.mean(radius, radius + 0.02), 4.0) << radius;
    }
}

TEST(NoiseKinds, channels_of_blue_noise_are_independent) {
    const Image& noise = blue_noise();
    for (int a = 0; a < 4; ++a)
        for (int b = 0; b < a; ++b)
            EXPECT_LT(std::abs(correlation(plane_of(noise, a), plane_of(noise, b))), 5.0 / 128.0);
}

TEST(NoiseKinds, volumes_are_uniform_and_share_their_first_bytes) {
    const VolumeData grey = make_noise_volume(NoiseVolume::grey_32);
    const VolumeData rgba = make_noise_volume(NoiseVolume::rgba_32);
    for (const VolumeData* volume : {&grey, &rgba}) {
        EXPECT_EQ(volume->width, 32);
        EXPECT_EQ(volume->height, 32);
        EXPECT_EQ(volume->depth, 32);
        EXPECT_EQ(volume->type, SampleType::u8);
        EXPECT_EQ(volume->bytes.size(), volume->samples());
        std::vector<double> plane;
        for (const std::byte byte : volume->bytes)
            plane.push_back(double(byte));
        EXPECT_NEAR(chi_squared(plane), 255.0, 4.0 * 22.6);
    }
    EXPECT_EQ(grey.channels, 1);
    EXPECT_EQ(rgba.channels, 4);
    EXPECT_TRUE(std::equal(grey.bytes.begin(), grey.bytes.end(), rgba.bytes.begin()));
}

TEST(NoiseKinds, a_seed_is_repeatable_and_seeds_differ) {
    for (const NoiseTexture kind :
         {NoiseTexture::rgba_64, NoiseTexture::grey_64, NoiseTexture::grey_256, NoiseTexture::blue_1024}) {
        EXPECT_EQ(make_noise(kind, 3), make_noise(kind, 3));
        EXPECT_NE(make_noise(kind, 3), make_noise(kind, 4));
    }
    EXPECT_NE(make_noise_volume(NoiseVolume::grey_32, 3), make_noise_volume(NoiseVolume::grey_32, 4));
}

} // namespace tidemark::image::noise_kinds_test
