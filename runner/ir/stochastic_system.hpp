// The number system of stochastic arithmetic: a real number is a few floats, each computed with every
// operation rounded up or down by lot, so that what they have in common are the digits that rounding leaves.
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
/// Of a float: 24 log10 2.
inline constexpr double k_most_digits = 7.22471989593555;

/// A whole number is one in each sample, too: what it was made from may have been rounded otherwise.
using Samples = std::array<Point<float>, k_samples>;

/// Relative to its size, within what a vector's (a scalar's) real value lies with a probability of 95 %; 0
/// where all samples agree, infinite where they have nothing in common.
double relative_spread(std::span<const Samples> components);
/// Decimal digits that the samples have in common, 0 to k_most_digits.
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

    /// What most samples say.
    static std::optional<bool> decide(const Value& condition);
    static std::pair<int64_t, int64_t> range(const Value& index) {
        return PointSystem<float>::range(index[0]);
    }
    static Value hull(const Value& a, const Value&) { return a; }
    static std::optional<std::pair<Value, Value>> split(Op, const Operands<Value>&) { return std::nullopt; }

private:
    /// One of the two floats around it, by the next choice; a float is itself.
    float rounded(double exact);
    float real_number(Op op, float a, float b, float c);
    uint64_t draw();

    uint64_t state_;
    uint64_t choices_ = 0; ///< for the roundings of the operation at hand, a bit each
};

} // namespace tidemark::ir
