#include "sound/spectrum.hpp"

#include <cmath>

namespace tidemark::sound {
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
