// Number systems for evaluation: intervals, intervals with derivatives, stochastic arithmetic, and three at
// once.
//
// The number system of intervals: the results of the text in real arithmetic for all numbers of its operands.
// An operand of a single number is one of the scene's floats; results of such operands alone are computed in
// float, as a driver does, so hashes of lattice points equal the scene's. Whole numbers and booleans are
// intervals, too.
#pragma once

#include "proof/evaluate.hpp"
#include "proof/interval.hpp"
#include "proof/point.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace tidemark::proof {

class IntervalSystem {
public:
    using Value = Interval;

    static Value constant(uint32_t bits, Scalar type);
    static Value number(double real);
    static Value unknown() { return everything(); }

    Value compute(Op op, Scalar result, Scalar of, const Operands<Value>& operands) const;

    static std::optional<bool> decide(const Value& condition);
    static std::pair<int64_t, int64_t> range(const Value& index);
    static Value hull(const Value& a, const Value& b) { return proof::hull(a, b); }
    static std::optional<std::pair<Value, Value>> split(Op op, const Operands<Value>& operands);
    static bool may_be_split(const Value& number) { return !number.point(); }
};

// The number system of intervals with a derivative: bounds of a value over a piece of a ray, and of its slope
// along the ray (R. E. Moore: Interval Analysis, 1966; forward mode). At a kink, of abs() or min(), the
// slopes of both sides are included (F. H. Clarke: Optimization and Nonsmooth Analysis, 1983), so the mean
// value theorem holds; if the value may jump, the slope is unbounded.

struct Tangent {
    Interval value;
    Interval slope;

    /// Returns whether the value does not change over the piece.
    bool constant() const { return slope.low == 0 && slope.high == 0; }
};

class TangentSystem {
public:
    using Value = Tangent;

    /// If true, slopes are those on both sides of jumps; else the slope of a value that may jump is
    /// unbounded.
    bool jumps_aside = false;

    static Value constant(uint32_t bits, Scalar type) { return {IntervalSystem::constant(bits, type), {}}; }
    static Value number(double real) { return {IntervalSystem::number(real), {}}; }
    static Value unknown() { return {everything(), everything()}; }

    Value compute(Op op, Scalar result, Scalar of, const Operands<Value>& operands) const;

    static std::optional<bool> decide(const Value& condition) {
        return IntervalSystem::decide(condition.value);
    }
    static std::pair<int64_t, int64_t> range(const Value& index) {
        return IntervalSystem::range(index.value);
    }
    /// Combines two memory cells of which either may be read: the value may jump.
    Value hull(const Value& a, const Value& b) const {
        return {proof::hull(a.value, b.value), jumps_aside ? proof::hull(a.slope, b.slope) : everything()};
    }
    static std::optional<std::pair<Value, Value>> split(Op, const Operands<Value>&) { return std::nullopt; }
    static bool may_be_split(const Value&) { return false; }
};

// The number system of stochastic arithmetic: a real number is a few floats, each computed with every
// operation rounded up or down at random, so their common digits are those that rounding leaves correct.
// CESTAC: J. Vignes, A stochastic arithmetic for reliable scientific computation, Mathematics and Computers
// in Simulation 35 (1993); its proof and its limits: J.-M. Chesneaux, L'arithmétique stochastique et le
// logiciel CADNA (1995). The number of samples and Student's factor are those of CADNA.

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

// The number system of three at once: each number in float, as written in the text, in double, and in samples
// of stochastic arithmetic. Conditions are decided by the float alone, so all three take the same path and
// loop iterations correspond; the condition's value shows whether double or a sample would have branched
// otherwise.

struct Lockstep {
    Point<float> in_float{};
    Point<double> in_double{};
    Samples samples{};

    /// For conditions and whole numbers: whether double, or a sample, has another value than float.
    bool double_differs() const { return in_double.bits != in_float.bits; }
    bool rounding_decides() const {
        return std::ranges::any_of(samples, [&](const auto& each) { return each.bits != in_float.bits; });
    }
};

class LockstepSystem {
public:
    using Value = Lockstep;

    explicit LockstepSystem(uint64_t seed = 1) : stochastic_(seed) {}

    static Value constant(uint32_t bits, Scalar type) {
        return {PointSystem<float>::constant(bits, type), PointSystem<double>::constant(bits, type),
                StochasticSystem::constant(bits, type)};
    }
    static Value unknown() {
        return {PointSystem<float>::unknown(), PointSystem<double>::unknown(), StochasticSystem::unknown()};
    }
    /// Returns an input value, which is exact in all three.
    static Value exactly(const Point<float>& point) {
        return {point, {point.real, point.bits}, StochasticSystem::all(point)};
    }

    Value compute(Op op, Scalar result, Scalar of, const Operands<Value>& operands) {
        // the condition's float decides
        const Value a = op == Op::select ? exactly(operands.a.in_float) : operands.a;
        const auto& [_, b, c] = operands;
        return {PointSystem<float>().compute(op, result, of, {a.in_float, b.in_float, c.in_float}),
                PointSystem<double>().compute(op, result, of, {a.in_double, b.in_double, c.in_double}),
                stochastic_.compute(op, result, of, {a.samples, b.samples, c.samples})};
    }

    static std::optional<bool> decide(const Value& condition) { return condition.in_float.bits != 0; }
    static std::pair<int64_t, int64_t> range(const Value& index) {
        return PointSystem<float>::range(index.in_float);
    }
    static Value hull(const Value& a, const Value&) { return a; }
    static std::optional<std::pair<Value, Value>> split(Op, const Operands<Value>&) { return std::nullopt; }

private:
    StochasticSystem stochastic_;
};

using LockstepEvaluator = Evaluator<LockstepSystem>;

} // namespace tidemark::proof
