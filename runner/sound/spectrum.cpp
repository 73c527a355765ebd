#include "sound/spectrum.hpp"

#include "sound/resample.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::sound {
namespace {

constexpr int k_steps_a_second = 60;
constexpr int k_samples_a_step = k_analysed_rate / k_steps_a_second;
constexpr size_t k_remembered = 128;

/// Returns the sample, or step, at a time; a time just below a whole number through rounding counts as that
/// number.
int64_t whole_steps(double time, double rate) {
    return int64_t(std::floor(time * rate + 1e-4));
}

/// Returns the weights of WebAudio 1.0, 1.8.6, "down-mixing": 5.1 has weights of its own; all other layouts
/// count their channels equally.
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

float sample_at(const std::vector<float>& samples, int64_t index) {
    return index >= 0 && index < int64_t(samples.size()) ? samples[size_t(index)] : 0.0f;
}

} // namespace

Spectrum::Spectrum(const SoundData& sound)
    : duration_(sound.duration()), mono_(resampled(mixed_down(sound), sound.rate, k_analysed_rate)) {}

Block Spectrum::block_before(int64_t end) const {
    Block block;
    for (size_t n = 0; n < k_block; ++n)
        block[n] = sample_at(mono_, end - int64_t(k_block) + int64_t(n));
    return block;
}

void Spectrum::step_to(int64_t step) {
    if (step < newest_ || step > newest_ + int64_t(k_remembered)) {
        recent_.clear();
        newest_ = std::max<int64_t>(-1, step - int64_t(k_remembered));
    }
    while (newest_ < step) {
        recent_.push_back(magnitudes_of(block_before(++newest_ * k_samples_a_step)));
        if (recent_.size() > k_remembered)
            recent_.pop_front();
    }
}

SignalBytes Spectrum::at(double time) {
    // After the end the smoothed spectrum fades; after 128 steps it is silent.
    if (!(time >= 0.0) || time > duration_ + 3.0)
        return signal_bytes({}, Block{});
    step_to(whole_steps(time, k_steps_a_second));
    // Starts from zero each time: a mean that continues would depend on where it began.
    Magnitudes mean{};
    for (const Magnitudes& magnitudes : recent_)
        smooth(mean, magnitudes);
    return signal_bytes(mean, block_before(whole_steps(time, k_analysed_rate)));
}

} // namespace tidemark::sound
