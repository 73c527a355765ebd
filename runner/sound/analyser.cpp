#include "sound/analyser.hpp"

#include "sound/fft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tidemark::sound {
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

} // namespace tidemark::sound
