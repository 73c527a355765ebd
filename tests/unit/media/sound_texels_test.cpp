#include "media/sound_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tidemark::sound::sound_texels_test {

TEST(SoundTexels, low_byte_first_left_before_right) {
    const std::vector<uint8_t> rgba = {0, 0, 255, 255, 0, 255, 255, 0};
    EXPECT_EQ(decode_sound_texels(rgba), (std::vector<int16_t>{-32767, 32767, 32512, -32512}));
}

TEST(SoundTexels, every_pair_of_bytes_is_the_nearest_sample) {
    for (int packed = 0; packed < 65536; ++packed) {
        const std::vector<uint8_t> rgba = {uint8_t(packed & 255), uint8_t(packed >> 8), 0, 0};
        const double exact = 32767.0 * (2.0 * packed - 65535.0) / 65535.0;
        ASSERT_LE(std::abs(decode_sound_texels(rgba)[0] - exact), 0.5000001) << packed;
    }
}

TEST(SoundTexels, packed_samples_are_decoded) {
    // The site's packing: floor((0.5 + 0.5 s) 65536)
    for (const double s : {-1.0, -0.5, -0.001, 0.0, 0.25, 0.999}) {
        const double v = std::floor((0.5 + 0.5 * s) * 65536.0);
        const std::vector<uint8_t> rgba = {uint8_t(std::fmod(v, 256.0)), uint8_t(v / 256.0), 0, 0};
        EXPECT_NEAR(decode_sound_texels(rgba)[0], 32767.0 * s, 1.0) << s;
    }
}

TEST(SoundTexels, no_texels_give_no_samples) {
    EXPECT_TRUE(decode_sound_texels({}).empty());
}

} // namespace tidemark::sound::sound_texels_test
