#include "sound/resample.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>

namespace tidemark::sound {
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

} // namespace tidemark::sound
