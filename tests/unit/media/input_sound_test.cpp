#include "media/sound_file.hpp"
#include "unit/media/sound_support.hpp"

#include <gmock/gmock.h>

#include <array>
#include <vector>

namespace tidemark::sound::input_sound_test {
namespace {

/// Stereo whose left sample n is n + 1 and whose right one is -(n + 1), in steps of 16 bits.
InputSound counted(size_t frames, double start = 0, double loop = 0, int rate = 1000) {
    SoundData data{rate, 2, {}};
    for (size_t n = 1; n <= frames; ++n)
        for (const int side : {1, -1})
            data.samples.push_back(float(side * int(n)) / 32768);
    return {std::move(data), start, loop > 0 ? loop : double(frames) / rate};
}

std::vector<int> left_of(const LoopedSound& sound, int64_t first, size_t count) {
    std::vector<float> mix(2 * count);
    sound.add(first, mix);
    std::vector<int> left;
    for (size_t i = 0; i < count; ++i) {
        EXPECT_EQ(mix[2 * i], -mix[2 * i + 1]);
        left.push_back(int(mix[2 * i]));
    }
    return left;
}

using Samples = std::vector<int>;

TEST(LoopedSoundTest, samples_are_unchanged_and_loop) {
    const LoopedSound sound(counted(3), 1000);
    EXPECT_EQ(left_of(sound, 0, 8), (Samples{1, 2, 3, 1, 2, 3, 1, 2}));
    EXPECT_EQ(left_of(sound, 5, 2), (Samples{3, 1}));
    EXPECT_EQ(left_of(sound, -2, 4), (Samples{0, 0, 1, 2})); // silent before iTime 0
    EXPECT_EQ(left_of(sound, 3'000'000'000, 3), (Samples{1, 2, 3}));
}

TEST(LoopedSoundTest, a_loop_may_be_longer_or_shorter_than_the_sound) {
    EXPECT_EQ(left_of({counted(2, 0, 0.004), 1000}, 0, 6), (Samples{1, 2, 0, 0, 1, 2}));
    EXPECT_EQ(left_of({counted(9, 0, 0.002), 1000}, 1, 4), (Samples{2, 1, 2, 1}));
    // 3.5 samples: each time round begins with the sample nearest to it.
    EXPECT_EQ(left_of({counted(9, 0, 0.0035), 1000}, 0, 8), (Samples{1, 2, 3, 4, 2, 3, 4, 1}));
}

TEST(LoopedSoundTest, a_sound_may_start_before_or_after_its_picture) {
    EXPECT_EQ(left_of({counted(2, 0.001, 0.004), 1000}, 0, 6), (Samples{0, 1, 2, 0, 0, 1}));
    EXPECT_EQ(left_of({counted(9, -0.002, 0.003), 1000}, 0, 5), (Samples{3, 4, 5, 3, 4}));
}

TEST(LoopedSoundTest, another_sample_rate_keeps_the_timing) {
    const SoundData tone = sine(441, 0.5, 1, 48000);
    const LoopedSound sound({tone, 0, tone.duration()}, 44100);
    std::vector<float> mix(2 * 44100);
    sound.add(44100, mix); // the second time round
    const SoundData wanted = sine(441, 0.5, 1, 44100);
    for (size_t n = 100; n < 44000; ++n) {
        ASSERT_NEAR(mix[2 * n], 32768 * wanted.samples[n], 3) << n;
        ASSERT_EQ(mix[2 * n], mix[2 * n + 1]);
    }
}

TEST(LoopedSoundTest, channels_become_stereo) {
    const auto sides = [](std::vector<float> samples) {
        const int channels = int(samples.size());
        for (float& sample : samples)
            sample /= 32768;
        const LoopedSound sound({{1000, channels, std::move(samples)}, 0, 0.001}, 1000);
        std::array<float, 2> mix{};
        sound.add(0, mix);
        return mix;
    };
    EXPECT_EQ(sides({100}), (std::array{100.0F, 100.0F}));
    EXPECT_EQ(sides({100, 7}), (std::array{100.0F, 7.0F}));
    EXPECT_EQ(sides({100, 7, 300}), (std::array{200.0F, 7.0F}));
    EXPECT_EQ(sides({100, 8, 300, 2}), (std::array{200.0F, 5.0F}));
    EXPECT_EQ(sides({1000, 2000, 100, 5000, 300, 400}), (std::array{1283.0F, 2354.0F}));
}

TEST(Mix, one_sound_is_hard_clipped_and_several_are_soft_clipped) {
    const std::vector<float> mix{0, 1000, -24576, 30000, -60000, 200000, 32767.6F};
    EXPECT_EQ(in_16_bits(mix, false), (std::vector<int16_t>{0, 1000, -24576, 30000, -32768, 32767, 32767}));
    const std::vector<int16_t> soft = in_16_bits(mix, true);
    EXPECT_EQ(std::vector(soft.begin(), soft.begin() + 3), (std::vector<int16_t>{0, 1000, -24576}));
    EXPECT_THAT(soft[3], testing::AllOf(testing::Gt(28000), testing::Lt(30000)));
    EXPECT_THAT(soft[4], testing::AllOf(testing::Lt(-32700), testing::Ge(-32767)));
    EXPECT_EQ(soft[5], 32767);
}

TEST(Mix, rates) {
    EXPECT_EQ(mixing_rate(std::array{44100}), 44100);
    EXPECT_EQ(mixing_rate(std::array{96000, 96000}), 96000);
    EXPECT_EQ(mixing_rate(std::array{44100, 32000}), 48000);
    EXPECT_EQ(mixing_rate(std::array{192000}), 48000);
    EXPECT_EQ(rate_words(44100, 2), "44.1 kHz stereo");
    EXPECT_EQ(rate_words(8000, 1), "8 kHz mono");
    EXPECT_EQ(rate_words(48000, 6), "48 kHz, 6 channels");
}

TEST(AudioTrack, parses_lines_of_ashowinfo) {
    const auto shown =
        ashowinfo_samples("[Parsed_ashowinfo_1 @ 0x55d4] [info] n:1 pts:4608 pts_time:0.10449 pos:3552 "
                          "fmt:s16 channels:2 chlayout:stereo rate:44100 nb_samples:1024 checksum:61D");
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->first, 4608);
    EXPECT_EQ(shown->rate, 44100);
    EXPECT_EQ(shown->channels, 2);
    EXPECT_EQ(shown->count, 1024U);
    EXPECT_FALSE(ashowinfo_samples("[info] n:1 pts:4608 channels:2 rate:44100 nb_samples:1024"));
    EXPECT_FALSE(ashowinfo_samples(
        "[Parsed_ashowinfo_1 @ 0x55d4] [info] n:1 pts:NOPTS channels:2 rate:44100 nb_samples:9"));
}

} // namespace
} // namespace tidemark::sound::input_sound_test
