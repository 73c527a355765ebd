// The number system of stochastic arithmetic: a real number is a few floats, each computed with every
// operation rounded up or down at random, so their common digits are those that rounding leaves correct.
// CESTAC: J. Vignes, A stochastic arithmetic for reliable scientific computation, Mathematics and Computers
// in Simulation 35 (1993); its proof and its limits: J.-M. Chesneaux, L'arithmétique stochastique et le
// logiciel CADNA (1995). The number of samples and Student's factor are those of CADNA.
#pragma once

#include "ir/point.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace tidemark::ir {

inline constexpr size_t k_samples = 3;
/// Digits of a float: 24 log10 2.
inline constexpr double k_most_digits = 7.22471989593555;

/// A whole number has a value in each sample, too: it may come from reals that were rounded differently.
using Samples = std::array<Point<float>, k_samples>;

/// Returns the half-width of the 95 % confidence interval of a vector (or scalar), relative to its size; 0 if
/// all samples agree, infinite if they have nothing in common.
double relative_spread(std::span<const Samples> components);
/// Returns the number of decimal digits that the samples have in common, 0 to k_most_digits.
double significant_digits(double relative_spread);
inline double significant_digits(std::span<const Samples> components) {
    return significant_digits(relative_spread(components));
}

class StochasticSystem {
public:
    using Value = Samples;

    explicit StochasticSystem(uint64_t seed = 1) : state_(seed) {}

    static Value constant(uint32_t bits, Scalar type) {
        return all(PointSystem<float>::constant(bits, type));
    }
    static Value unknown() { return all(PointSystem<float>::unknown()); }
    static Value all(const Point<float>& point) {
        Value result;
        result.fill(point);
        return result;
    }

    Value compute(Op op, Scalar result, Scalar of, const Operands<Value>& operands);

    /// Returns the majority of the samples.
    static std::optional<bool> decide(const Value& condition);
    static std::pair<int64_t, int64_t> range(const Value& index) {
        return PointSystem<float>::range(index[0]);
    }
    static Value hull(const Value& a, const Value&) { return a; }
    static std::optional<std::pair<Value, Value>> split(Op, const Operands<Value>&) { return std::nullopt; }

private:
    /// Returns one of the two floats around `exact`, by the next random bit; a float is returned unchanged.
    float rounded(double exact);
    float real_number(Op op, float a, float b, float c);
    uint64_t draw();

    uint64_t state_;
    uint64_t choices_ = 0; ///< random bits for the roundings of the current operation
};

} // namespace tidemark::ir
