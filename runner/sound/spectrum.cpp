#include "sound/spectrum.hpp"

#include "sound/fft.hpp"
#include "sound/resample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tidemark::sound {
namespace {

constexpr int k_rate = 44100;
constexpr int64_t k_block = 2048;
constexpr int k_steps_a_second = 60;
constexpr int k_samples_a_step = k_rate / k_steps_a_second;
constexpr size_t k_remembered = 128;
constexpr float k_smoothing = 0.8f;

/// Which sample, or step, a time falls on: a time that is a whole number of them but for rounding is that
/// one.
int64_t whole_steps(double time, double rate) {
    return int64_t(std::floor(time * rate + 1e-4));
}

/// WebAudio 1.0, 1.8.6, "down-mixing": stereo, quad and 5.1 have weights of their own; what has none counts
/// equally.
std::vector<float> down_mix_weights(int channels) {
    switch (channels) {
    case 6: return {0.70710678f, 0.70710678f, 1.0f, 0.0f, 0.5f, 0.5f};
    default: return std::vector<float>(size_t(channels), 1.0f / float(channels));
    }
}

std::vector<float> mixed_down(const SoundData& sound) {
    const std::vector<float> weights = down_mix_weights(sound.channels);
    std::vector<float> mono(sound.frames());
    for (size_t frame = 0; frame < mono.size(); ++frame)
        for (size_t channel = 0; channel < weights.size(); ++channel)
            mono[frame] += weights[channel] * sound.samples[frame * weights.size() + channel];
    return mono;
}

/// Blackman with alpha = 0.16, periodic, as the specification of AnalyserNode writes it.
double window(int64_t n) {
    constexpr double alpha = 0.16;
    const double turn = 2.0 * std::numbers::pi * double(n) / double(k_block);
    return (1.0 - alpha) / 2.0 - 0.5 * std::cos(turn) + alpha / 2.0 * std::cos(2.0 * turn);
}

uint8_t byte_of_magnitude(float magnitude) {
    constexpr double least = -100.0, most = -30.0;
    const double decibels = 20.0 * std::log10(double(magnitude)); // of 0: minus infinity
    const double scaled = std::floor(255.0 / (most - least) * (decibels - least));
    return scaled > 0.0 ? uint8_t(std::min(scaled, 255.0)) : uint8_t(0);
}

uint8_t byte_of_wave(float sample) {
    const float scaled = std::floor(128.0f * (1.0f + sample));
    return scaled > 0.0f ? uint8_t(std::min(scaled, 255.0f)) : uint8_t(0);
}

float sample_at(const std::vector<float>& samples, int64_t index) {
    return index >= 0 && index < int64_t(samples.size()) ? samples[size_t(index)] : 0.0f;
}

} // namespace

Spectrum::Spectrum(const SoundData& sound)
    : duration_(sound.duration()), mono_(resampled(mixed_down(sound), sound.rate, k_rate)) {}

Spectrum::Magnitudes Spectrum::magnitudes_at_step(int64_t step) const {
    const int64_t first = step * k_samples_a_step - k_block;
    std::array<std::complex<double>, k_block> block;
    for (int64_t n = 0; n < k_block; ++n)
        block[size_t(n)] = window(n) * double(sample_at(mono_, first + n));
    transform(block);
    Magnitudes magnitudes;
    for (size_t k = 0; k < magnitudes.size(); ++k)
        magnitudes[k] = float(std::abs(block[k]) / double(k_block));
    return magnitudes;
}

void Spectrum::step_to(int64_t step) {
    if (step < newest_ || step > newest_ + int64_t(k_remembered)) {
        recent_.clear();
        newest_ = std::max<int64_t>(-1, step - int64_t(k_remembered));
    }
    while (newest_ < step) {
        recent_.push_back(magnitudes_at_step(++newest_));
        if (recent_.size() > k_remembered)
            recent_.pop_front();
    }
}

SignalBytes Spectrum::at(double time) {
    SignalBytes bytes{};
    std::fill(bytes.begin() + k_signal_width, bytes.end(), byte_of_wave(0.0f));
    // After the end the smoothed spectrum fades; 128 steps later nothing is left of it.
    if (!(time >= 0.0) || time > duration_ + 3.0)
        return bytes;
    step_to(whole_steps(time, k_steps_a_second));
    // From nothing every time: carried on, the sum would depend on where it began.
    Magnitudes smoothed{};
    for (const Magnitudes& magnitudes : recent_)
        for (size_t k = 0; k < smoothed.size(); ++k)
            smoothed[k] = k_smoothing * smoothed[k] + (1.0f - k_smoothing) * magnitudes[k];
    std::transform(smoothed.begin(), smoothed.end(), bytes.begin(), byte_of_magnitude);
    const int64_t oldest = whole_steps(time, k_rate) - k_block;
    for (int i = 0; i < k_signal_width; ++i)
        bytes[size_t(k_signal_width + i)] = byte_of_wave(sample_at(mono_, oldest + i));
    return bytes;
}

} // namespace tidemark::sound
