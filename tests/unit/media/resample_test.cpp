#include "media/spectrum.hpp"
#include "unit/media/sound_support.hpp"

#include <algorithm>

namespace tidemark::sound::resample_test {

TEST(Resample, keeps_samples_of_the_same_rate) {
    const SoundData sound = sine(440.0, 0.5, 0.1);
    EXPECT_EQ(resampled(sound.samples, 44100, 44100), sound.samples);
}

TEST(Resample, a_sine_is_unchanged) {
    for (const int rate : {8000, 11025, 22050, 32000, 44101, 48000, 96000, 192000}) {
        const double hertz = 3000.0;
        const SoundData wanted = sine(hertz, 0.5, 0.5);
        const std::vector<float> result = resampled(sine(hertz, 0.5, 0.5, rate).samples, rate, 44100);
        ASSERT_NEAR(double(result.size()), double(wanted.samples.size()), 2.0) << rate;
        double largest = 0.0;
        for (size_t n = 500; n + 500 < result.size(); ++n) // away from where the sine begins and ends
            largest = std::max(largest, std::abs(double(result[n]) - double(wanted.samples[n])));
        EXPECT_LT(largest, 0.002) << rate;
    }
}

TEST(Resample, frequencies_above_half_the_new_rate_are_removed) {
    const std::vector<float> result = resampled(sine(30000.0, 0.5, 0.5, 96000).samples, 96000, 44100);
    for (size_t n = 500; n + 500 < result.size(); ++n)
        ASSERT_LT(std::abs(result[n]), 0.001f);
}

TEST(Resample, constants_and_empty_sounds_are_unchanged) {
    const std::vector<float> result = resampled(std::vector<float>(4800, 0.25f), 48000, 44100);
    EXPECT_EQ(result.size(), 4410u);
    for (size_t n = 50; n + 50 < result.size(); ++n)
        ASSERT_NEAR(result[n], 0.25f, 1e-6f);
    EXPECT_TRUE(resampled({}, 48000, 44100).empty());
}

} // namespace tidemark::sound::resample_test
