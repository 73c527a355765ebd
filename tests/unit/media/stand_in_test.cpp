#include "base/encoding.hpp"
#include "media/generated_textures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tidemark::image::stand_in_test {

TEST(StandIn, has_the_requested_size_and_channels) {
    for (int channels = 1; channels <= 4; ++channels) {
        const Image picture = make_stand_in_picture("a.png", {48, 32}, channels);
        EXPECT_EQ(picture.extent, (Extent{48, 32}));
        EXPECT_EQ(picture.channels, channels);
        EXPECT_EQ(picture.bytes.size(), picture.samples());
        const CubeFaces cube = make_stand_in_cube("a.png", 16, channels);
        for (const Image& face : cube) {
            EXPECT_EQ(face.extent, (Extent{16, 16}));
            EXPECT_EQ(face.channels, channels);
        }
        const VolumeData volume = make_stand_in_volume("a.bin", 8, 4, 2, channels);
        EXPECT_EQ(volume.width, 8);
        EXPECT_EQ(volume.height, 4);
        EXPECT_EQ(volume.depth, 2);
        EXPECT_EQ(volume.bytes.size(), size_t(64 * channels));
        if (channels % 2 == 0) {
            for (size_t i = size_t(channels) - 1; i < picture.samples(); i += size_t(channels))
                ASSERT_EQ(picture.u8()[i], 255);
        }
    }
}

TEST(StandIn, a_name_is_repeatable_and_names_differ) {
    EXPECT_EQ(make_stand_in_picture("a", {64, 64}, 3), make_stand_in_picture("a", {64, 64}, 3));
    EXPECT_NE(make_stand_in_picture("a", {64, 64}, 3), make_stand_in_picture("b", {64, 64}, 3));
    EXPECT_NE(make_stand_in_cube("a", 8, 3), make_stand_in_cube("b", 8, 3));
    EXPECT_NE(make_stand_in_volume("a", 8, 8, 8, 1), make_stand_in_volume("b", 8, 8, 8, 1));
}

TEST(StandIn, values_are_of_the_middle_range_and_vary) {
    for (const char* name : {"abstract.jpg", "wood.jpg", "london.jpg", "x", ""}) {
        const Image picture = make_stand_in_picture(name, {256, 256}, 1);
        double sum = 0.0, squares = 0.0;
        for (const uint8_t value : picture.u8()) {
            ASSERT_GE(value, 40);
            ASSERT_LE(value, 215);
            sum += value;
            squares += value * value;
        }
        const double mean = sum / 65536.0;
        EXPECT_NEAR(mean, 127.5, 25.0) << name;
        EXPECT_GT(std::sqrt(squares / 65536.0 - mean * mean), 12.0) << name;
    }
}

/// The mean difference of neighbouring pixels along x, of columns `a` and `b`.
double step(const Image& image, int a, int b) {
    double sum = 0.0;
    for (int y = 0; y < image.extent.height; ++y)
        sum += std::abs(image.u8()[size_t(y * image.extent.width + a)] -
                        image.u8()[size_t(y * image.extent.width + b)]);
    return sum / image.extent.height;
}

TEST(StandIn, a_picture_tiles) {
    const Image picture = make_stand_in_picture("tile", {128, 128}, 1);
    double inside = 0.0;
    for (int x = 0; x + 1 < 128; ++x)
        inside = std::max(inside, step(picture, x, x + 1));
    EXPECT_LE(step(picture, 127, 0), inside);
    EXPECT_GT(step(picture, 64, 0), 2.0 * step(picture, 127, 0)); // and it is not constant
}

TEST(StandIn, a_volume_tiles_in_depth) {
    const VolumeData volume = make_stand_in_volume("tile", 16, 16, 64, 1);
    const auto slice_step = [&](int a, int b) {
        double sum = 0.0;
        for (size_t i = 0; i < 256; ++i)
            sum += std::abs(int(volume.bytes[size_t(a) * 256 + i]) - int(volume.bytes[size_t(b) * 256 + i]));
        return sum / 256.0;
    };
    double inside = 0.0;
    for (int z = 0; z + 1 < 64; ++z)
        inside = std::max(inside, slice_step(z, z + 1));
    EXPECT_LE(slice_step(63, 0), inside);
}

TEST(StandIn, a_cube_has_no_seams_and_is_lighter_above) {
    const CubeFaces faces = make_stand_in_cube("sky", 64, 1);
    const auto at = [&](size_t face, int x, int y) { return int(faces[face].u8()[size_t(y * 64 + x)]); };
    int largest = 0;
    for (int i = 0; i < 64; ++i) {
        largest = std::max(largest, std::abs(at(4, 63, i) - at(0, 0, i))); // +Z right, +X left
        largest = std::max(largest, std::abs(at(0, 63, i) - at(5, 0, i))); // +X right, -Z left
        largest = std::max(largest, std::abs(at(2, i, 63) - at(4, i, 0))); // +Y below, +Z above
        largest = std::max(largest, std::abs(at(4, i, 63) - at(3, i, 0))); // +Z below, -Y above
    }
    EXPECT_LT(largest, 16);
    const auto mean = [&](size_t face) {
        double sum = 0.0;
        for (const uint8_t value : faces[face].u8())
            sum += value;
        return sum / 4096.0;
    };
    EXPECT_GT(mean(2), mean(3) + 10.0);
}

TEST(StandIn, bytes_are_the_same_on_every_machine) {
    const auto fingerprint = [](const std::vector<std::byte>& bytes) { return sha256(bytes).substr(0, 16); };
    EXPECT_EQ(fingerprint(make_stand_in_picture("wood.jpg", {64, 64}, 4).bytes), "af8d8c84e93320bd");
    EXPECT_EQ(fingerprint(make_stand_in_volume("cloud.bin", 16, 16, 16, 1).bytes), "d2ed0cb7015ec3ff");
}

} // namespace tidemark::image::stand_in_test
