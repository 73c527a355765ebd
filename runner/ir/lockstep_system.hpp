// The number system of three at once: each number in float, as written in the text, in double, and in samples
// of stochastic arithmetic. Conditions are decided by the float alone, so all three take the same path and
// loop iterations correspond; the condition's value shows whether double or a sample would have branched
// otherwise.
#pragma once

#include "ir/evaluate.hpp"
#include "ir/stochastic_system.hpp"

namespace tidemark::ir {

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

} // namespace tidemark::ir
