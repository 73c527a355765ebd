#include "media/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace tidemark::sound {
namespace {

using Complex = std::complex<double>;

/// Multiplies without the operator's handling of infinities, which costs more than the multiplication.
Complex product(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

void reverse_bits_of_indices(std::span<Complex> x) {
    size_t reversed = 0;
    for (size_t i = 1; i < x.size(); ++i) {
        size_t bit = x.size() >> 1;
        for (; (reversed & bit) != 0; bit >>= 1)
            reversed ^= bit;
        reversed ^= bit;
        if (i < reversed)
            std::swap(x[i], x[reversed]);
    }
}

} // namespace

void transform(std::span<Complex> x) {
    const size_t size = x.size();
    assert(std::has_single_bit(size));
    std::vector<Complex> turns(size / 2);
    for (size_t i = 0; i < turns.size(); ++i)
        turns[i] = std::polar(1.0, -2.0 * std::numbers::pi * double(i) / double(size));
    reverse_bits_of_indices(x);
    for (size_t half = 1; half < size; half *= 2) {
        const size_t stride = size / (2 * half);
        for (size_t first = 0; first < size; first += 2 * half) {
            for (size_t i = 0; i < half; ++i) {
                Complex& low = x[first + i];
                Complex& high = x[first + i + half];
                const Complex turned = product(high, turns[i * stride]);
                high = low - turned;
                low += turned;
            }
        }
    }
}

namespace {

constexpr int k_crossings = 16; ///< on each side
constexpr int64_t k_most_phases = 4096;

/// Weights of the samples around a place, for each of `phases` places between two samples.
class Kernel {
public:
    Kernel(int64_t phases, double step)
        : reach_(int(std::ceil(k_crossings * std::max(1.0, step)))), weights_(size_t(phases) * taps()) {
        const double cutoff = std::min(1.0, 1.0 / step);
        for (int64_t phase = 0; phase < phases; ++phase) {
            float* weights = &weights_[size_t(phase) * taps()];
            double sum = 0.0;
            for (int i = 0; i < int(taps()); ++i) {
                const double distance = (i - reach_ + 1) - double(phase) / double(phases);
                weights[i] = float(weight(distance, cutoff));
                sum += weights[i];
            }
            for (int i = 0; i < int(taps()); ++i)
                weights[i] = float(weights[i] / sum); // a constant signal keeps its value
        }
    }

    size_t taps() const { return 2 * size_t(reach_); }
    int reach() const { return reach_; }
    const float* weights(int64_t phase) const { return &weights_[size_t(phase) * taps()]; }

private:
    double weight(double distance, double cutoff) const {
        const double turn = std::numbers::pi * distance;
        const double sinc = distance == 0.0 ? 1.0 : std::sin(cutoff * turn) / (cutoff * turn);
        const double part = std::clamp(turn / reach_, -std::numbers::pi, std::numbers::pi);
        return sinc * (0.42 + 0.5 * std::cos(part) + 0.08 * std::cos(2.0 * part));
    }

    int reach_;
    std::vector<float> weights_;
};

} // namespace

std::vector<float> resampled(std::span<const float> samples, int from_rate, int to_rate) {
    if (from_rate == to_rate)
        return {samples.begin(), samples.end()};
    const int64_t divisor = std::gcd(from_rate, to_rate);
    const int64_t from = from_rate / divisor, to = to_rate / divisor;
    const int64_t phases = std::min(to, k_most_phases);
    const Kernel kernel(phases, double(from) / double(to));
    const auto size = int64_t(samples.size());
    std::vector<float> result(size_t((size * to + from - 1) / from));
    for (size_t n = 0; n < result.size(); ++n) {
        const int64_t place = int64_t(n) * from;
        const float* weights = kernel.weights(place % to * phases / to);
        const int64_t first = place / to - kernel.reach() + 1;
        const int64_t begin = std::max<int64_t>(0, -first);
        const int64_t end = std::min(int64_t(kernel.taps()), size - first);
        float sum = 0.0f;
        for (int64_t i = begin; i < end; ++i)
            sum += weights[i] * samples[size_t(first + i)];
        result[n] = sum;
    }
    return result;
}

namespace {

constexpr float k_smoothing = 0.8f;

/// Returns the periodic Blackman window with alpha = 0.16, as the specification of AnalyserNode defines it.
double window(size_t n) {
    constexpr double alpha = 0.16;
    const double turn = 2.0 * std::numbers::pi * double(n) / double(k_block);
    return (1.0 - alpha) / 2.0 - 0.5 * std::cos(turn) + alpha / 2.0 * std::cos(2.0 * turn);
}

uint8_t byte_of_magnitude(float magnitude) {
    constexpr double least = -100.0, most = -30.0;
    const double decibels = 20.0 * std::log10(double(magnitude)); // minus infinity for 0
    const double scaled = std::floor(255.0 / (most - least) * (decibels - least));
    return scaled > 0.0 ? uint8_t(std::min(scaled, 255.0)) : uint8_t(0);
}

uint8_t byte_of_wave(float sample) {
    const float scaled = std::floor(128.0f * (1.0f + sample));
    return scaled > 0.0f ? uint8_t(std::min(scaled, 255.0f)) : uint8_t(0);
}

} // namespace

Magnitudes magnitudes_of(const Block& block) {
    std::array<std::complex<double>, k_block> windowed;
    for (size_t n = 0; n < k_block; ++n)
        windowed[n] = window(n) * double(block[n]);
    transform(windowed);
    Magnitudes magnitudes;
    for (size_t k = 0; k < magnitudes.size(); ++k)
        magnitudes[k] = float(std::abs(windowed[k]) / double(k_block));
    return magnitudes;
}

void smooth(Magnitudes& mean, const Magnitudes& next) {
    for (size_t k = 0; k < mean.size(); ++k)
        mean[k] = k_smoothing * mean[k] + (1.0f - k_smoothing) * next[k];
}

SignalBytes signal_bytes(const Magnitudes& mean, const Block& block) {
    SignalBytes bytes;
    std::ranges::transform(mean, bytes.begin(), byte_of_magnitude);
    std::transform(block.begin(), block.begin() + k_signal_width, bytes.begin() + k_signal_width,
                   byte_of_wave);
    return bytes;
}

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

namespace {

/// ShaderToy's own approximation of 2 pi; the bytes depend on it late in a long run.
constexpr double k_turn = 6.2831;

double spectrum(int bin, double time) {
    const double pulse = std::pow(0.5 + 0.5 * std::sin(k_turn * time), 4.0);
    if (bin < 3)
        return pulse * (1.0 - bin / 3.0);
    return (0.75 + 0.25 * std::sin(10.0 * bin + 13.0 * time)) * std::exp(-3.0 * bin / k_signal_width);
}

double wave(int sample, double time) {
    const double x = double(sample) / k_signal_width;
    return 0.5 + 0.15 * std::sin(17.0 * time + 10.0 * k_turn * x) * std::sin(23.0 * time + 1.9 * x);
}

} // namespace

SignalBytes silent_signal(double time) {
    SignalBytes bytes;
    for (int i = 0; i < k_signal_width; ++i) {
        bytes[size_t(i)] = uint8_t(std::floor(255.0 * spectrum(i, time)));
        bytes[size_t(k_signal_width + i)] = uint8_t(std::floor(255.0 * wave(i, time)));
    }
    return bytes;
}

} // namespace tidemark::sound
