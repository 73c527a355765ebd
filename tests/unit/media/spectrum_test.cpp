#include "media/spectrum.hpp"
#include "unit/media/sound_support.hpp"

#include <algorithm>
#include <complex>
#include <random>
#include <vector>

namespace tidemark::sound::spectrum_test {

constexpr double k_bin = 44100.0 / 2048.0;

int loudest_bin(const SignalBytes& bytes) {
    return int(std::max_element(bytes.begin(), bytes.begin() + 512) - bytes.begin());
}

SoundData white_noise(double seconds) {
    std::mt19937 random(7);
    SoundData sound{44100, 1, {}};
    for (int n = 0; n < int(seconds * 44100); ++n)
        sound.samples.push_back(float(double(random()) / 4294967296.0 - 0.5) * 0.2f);
    return sound;
}

TEST(Spectrum, a_sine_is_in_its_bin) {
    for (const int bin : {3, 46, 200, 511}) {
        Spectrum spectrum(sine(bin * k_bin, 0.01, 2.0));
        EXPECT_EQ(loudest_bin(spectrum.at(1.5)), bin);
    }
    Spectrum concert_pitch(sine(440.0, 0.01, 2.0));
    EXPECT_EQ(loudest_bin(concert_pitch.at(1.5)), 20); // 20.43
}

TEST(Spectrum, height_is_decibels_below_full_scale) {
    // Half of the sine's amplitude is in the positive frequency, 0.42 is the mean of the window
    for (const double amplitude : {0.0001, 0.001, 0.01, 0.1}) {
        Spectrum spectrum(sine(100.0 * k_bin, amplitude, 2.0));
        const double decibels = 20.0 * std::log10(amplitude * 0.5 * 0.42);
        EXPECT_NEAR(spectrum.at(1.5)[100], 255.0 / 70.0 * (decibels + 100.0) - 0.5, 0.6) << amplitude;
    }
    Spectrum loud(sine(100.0 * k_bin, 1.0, 2.0));
    EXPECT_EQ(loud.at(1.5)[100], 255);
    Spectrum faint(sine(100.0 * k_bin, 1e-5, 2.0));
    EXPECT_EQ(faint.at(1.5)[100], 0);
}

/// Computes AnalyserNode's spectrum word by word as its specification does, for a call every sixtieth of a
/// second.
std::vector<double> plain_analyser(const SoundData& sound, int steps) {
    std::vector<double> smoothed(512, 0.0);
    for (int step = 0; step <= steps; ++step) {
        std::vector<double> block(2048);
        for (int n = 0; n < 2048; ++n) {
            const int at = step * 735 - 2048 + n;
            const double turn = 2.0 * std::numbers::pi * n / 2048.0;
            block[size_t(n)] = (at < 0 ? 0.0 : double(sound.samples[size_t(at)])) *
                               (0.42 - 0.5 * std::cos(turn) + 0.08 * std::cos(2.0 * turn));
        }
        for (int k = 0; k < 512; ++k) {
            std::complex<double> sum = 0.0;
            for (int n = 0; n < 2048; ++n)
                sum += block[size_t(n)] * std::polar(1.0, -2.0 * std::numbers::pi * (n * k % 2048) / 2048.0);
            smoothed[size_t(k)] = 0.8 * smoothed[size_t(k)] + 0.2 * std::abs(sum) / 2048.0;
        }
    }
    return smoothed;
}

TEST(Spectrum, matches_the_web_audio_specification) {
    const SoundData sound = white_noise(0.5);
    Spectrum spectrum(sound);
    const SignalBytes bytes = spectrum.at(6.0 / 60.0);
    const std::vector<double> wanted = plain_analyser(sound, 6);
    for (size_t k = 0; k < 512; ++k) {
        const double scaled = 255.0 / 70.0 * (20.0 * std::log10(wanted[k]) + 100.0);
        ASSERT_NEAR(bytes[k] + 0.5, scaled, 0.501) << k;
    }
}

TEST(Spectrum, a_single_frame_equals_the_frame_of_a_sequence) {
    const SoundData sound = white_noise(4.0);
    Spectrum in_order(sound), backwards(sound);
    std::vector<SignalBytes> frames;
    for (int frame = 0; frame < 240; ++frame)
        frames.push_back(in_order.at(frame / 60.0));
    for (int frame = 239; frame >= 0; frame -= 40)
        EXPECT_EQ(backwards.at(frame / 60.0), frames[size_t(frame)]) << frame;
    for (const int frame : {0, 1, 127, 128, 129, 200, 239}) {
        Spectrum alone(sound);
        EXPECT_EQ(alone.at(frame / 60.0), frames[size_t(frame)]) << frame;
    }
}

TEST(Spectrum, fades_by_a_fifth_per_step_after_the_sound) {
    Spectrum spectrum(sine(100.0 * k_bin, 0.01, 1.0));
    const int before = spectrum.at(1.2)[100], after = spectrum.at(1.2 + 6.0 / 60.0)[100];
    EXPECT_NEAR(before - after, 255.0 / 70.0 * -20.0 * 6.0 * std::log10(0.8), 1.01);
    EXPECT_EQ(spectrum.at(3.9)[100], 0);
    EXPECT_EQ(spectrum.at(1e9)[100], 0);
}

TEST(Spectrum, the_wave_is_the_oldest_quarter_of_the_block) {
    SoundData sound{44100, 1, {}};
    for (int n = 0; n < 44100; ++n)
        sound.samples.push_back(float(n % 250) / 125.0f - 1.0f);
    Spectrum spectrum(sound);
    const SignalBytes bytes = spectrum.at(30.0 / 60.0);
    for (int i = 0; i < 512; ++i) {
        const float sample = sound.samples[size_t(22050 - 2048 + i)];
        ASSERT_EQ(bytes[size_t(512 + i)], int(std::floor(128.0f * (1.0f + sample)))) << i;
    }
    const SignalBytes start = spectrum.at(0.0);
    EXPECT_TRUE(std::all_of(start.begin() + 512, start.end(), [](uint8_t b) { return b == 128; }));
}

TEST(Spectrum, overdriven_samples_are_clipped) {
    SoundData sound{44100, 1, std::vector<float>(44100, 3.0f)};
    EXPECT_EQ(Spectrum(sound).at(0.5)[600], 255);
    sound.samples.assign(44100, -3.0f);
    EXPECT_EQ(Spectrum(sound).at(0.5)[600], 0);
}

TEST(Spectrum, silence_has_no_spectrum_and_a_centred_wave) {
    Spectrum spectrum(SoundData{44100, 2, std::vector<float>(88200, 0.0f)});
    for (const double time : {-1.0, 0.0, 0.5, 1.0, 100.0, double(NAN), double(INFINITY)}) {
        const SignalBytes bytes = spectrum.at(time);
        for (int i = 0; i < 512; ++i) {
            ASSERT_EQ(bytes[size_t(i)], 0);
            ASSERT_EQ(bytes[size_t(512 + i)], 128);
        }
    }
}

TEST(Spectrum, channels_are_mixed_down) {
    SoundData sound = sine(100.0 * k_bin, 0.01, 1.0, 44100, 2);
    Spectrum both(sound);
    EXPECT_EQ(both.at(0.9), Spectrum(sine(100.0 * k_bin, 0.01, 1.0)).at(0.9));
    for (size_t i = 1; i < sound.samples.size(); i += 2)
        sound.samples[i] = -sound.samples[i];
    Spectrum opposed(sound);
    EXPECT_EQ(opposed.at(0.9)[100], 0);
}

TEST(Spectrum, bins_are_in_hertz_at_any_rate) {
    for (const int rate : {22050, 44100, 48000, 96000}) {
        Spectrum spectrum(sine(100.0 * k_bin, 0.01, 2.0, rate));
        EXPECT_EQ(loudest_bin(spectrum.at(1.5)), 100) << rate;
        EXPECT_NEAR(spectrum.at(1.5)[100], 169, 1) << rate;
    }
}

TEST(SilentSignal, equals_shadertoys) {
    // From the formulas, computed elsewhere
    struct Sample {
        double time;
        std::array<int, 11> bytes;
        int sum;
    };
    constexpr std::array<int, 11> places = {0, 1, 2, 3, 4, 100, 511, 512, 513, 600, 1023};
    const std::array<Sample, 3> samples = {{
        {0.0, {15, 10, 5, 126, 233, 135, 12, 127, 127, 115, 123}, 95008},
        {1.0, {15, 10, 5, 135, 211, 141, 12, 158, 159, 110, 135}, 95366},
        {12.34, {184, 123, 61, 246, 149, 73, 6, 149, 146, 150, 132}, 95533},
    }};
    for (const Sample& sample : samples) {
        const SignalBytes bytes = silent_signal(sample.time);
        for (size_t i = 0; i < places.size(); ++i)
            EXPECT_EQ(bytes[size_t(places[i])], sample.bytes[i]) << sample.time << ' ' << places[i];
        int sum = 0;
        for (const uint8_t byte : bytes)
            sum += byte;
        EXPECT_EQ(sum, sample.sum);
    }
}

} // namespace tidemark::sound::spectrum_test
