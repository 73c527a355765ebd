#include "ir/stochastic_system.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::ir {
namespace {

/// Student's factor for 95 % and two degrees of freedom, divided by the root of three samples.
constexpr double k_student = 4.302652729911275 / 1.7320508075688772;

bool gives_real(Op op, Scalar result, Scalar of) {
    if (op == Op::select || op == Op::bits_as || op == Op::ldexp)
        return false; // these do not round
    return result == Scalar::real && of == Scalar::real;
}

struct Distribution {
    double mean = 0, variance = 0;
};

/// Samples that are all the same infinity have no variance.
Distribution distribution_of(const Samples& samples) {
    Distribution result;
    for (const Point<float>& each : samples)
        result.mean += each.real / double(k_samples);
    if (std::ranges::all_of(samples, [&](const auto& each) { return each.real == samples[0].real; }))
        return result;
    for (const Point<float>& each : samples)
        result.variance += (each.real - result.mean) * (each.real - result.mean) / (k_samples - 1.0);
    return result;
}

} // namespace

double relative_spread(std::span<const Samples> components) {
    double size2 = 0, variance = 0;
    for (const Samples& component : components) {
        const Distribution found = distribution_of(component);
        size2 += found.mean * found.mean;
        variance += found.variance;
    }
    if (variance == 0)
        return 0;
    const double spread = k_student * std::sqrt(variance / size2);
    return std::isnan(spread) ? std::numeric_limits<double>::infinity() : spread;
}

double significant_digits(double relative_spread) {
    return std::clamp(-std::log10(relative_spread), 0.0, k_most_digits);
}

/// Returns the next number of the splitmix64 generator.
uint64_t StochasticSystem::draw() {
    uint64_t bits = state_ += 0x9e3779b97f4a7c15;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
    return bits ^ (bits >> 31);
}

float StochasticSystem::rounded(double exact) {
    const auto nearest = float(exact);
    if (double(nearest) == exact || !std::isfinite(nearest))
        return nearest;
    const float infinity = std::numeric_limits<float>::infinity();
    const bool to_nearest = choices_ & 1;
    choices_ >>= 1;
    return to_nearest ? nearest : std::nextafter(nearest, exact > nearest ? infinity : -infinity);
}

/// Rounds each step of a composite operation, as the text's own operators would. Single operations are
/// computed in double, in which a sum, product, quotient or root of floats is nearly exact.
float StochasticSystem::real_number(Op op, float a, float b, float c) {
    const auto product = [&](float x, float y) { return rounded(double(x) * y); };
    const auto difference = [&](float x, float y) { return rounded(double(x) - y); };
    switch (op) {
    case Op::modulo: return difference(a, product(b, std::floor(rounded(double(a) / b))));
    case Op::remainder: return difference(a, product(b, std::trunc(rounded(double(a) / b))));
    case Op::inverse_sqrt: return rounded(1.0 / rounded(std::sqrt(double(a))));
    case Op::mix: return rounded(double(product(a, difference(1, c))) + product(b, c));
    case Op::hermite: return product(product(a, a), difference(3, 2 * a));
    case Op::fract: return fract(a);
    default: return rounded(ir::real_number<double>(op, a, b, c));
    }
}

/// The last sample rounds opposite to the one before, as in CADNA, so three samples never agree by chance.
Samples StochasticSystem::compute(Op op, Scalar result, Scalar of, const Operands<Samples>& operands) {
    const auto& [a, b, c] = operands;
    Samples computed;
    uint64_t drawn = 0;
    for (size_t sample = 0; sample < k_samples; ++sample) {
        drawn = sample + 1 == k_samples ? ~drawn : draw();
        choices_ = drawn;
        computed[sample] =
            gives_real(op, result, of)
                ? Point<float>{real_number(op, a[sample].real, b[sample].real, c[sample].real), 0}
                : PointSystem<float>().compute(op, result, of, {a[sample], b[sample], c[sample]});
    }
    return computed;
}

std::optional<bool> StochasticSystem::decide(const Samples& condition) {
    const auto holds =
        std::ranges::count_if(condition, [](const Point<float>& each) { return each.bits != 0; });
    return size_t(holds) * 2 > k_samples;
}

} // namespace tidemark::ir
