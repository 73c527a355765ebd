// The number system of three at once: each number in float, as the text has it, in double, and in samples of
// stochastic arithmetic. Conditions are decided by the float alone, so that all three go the same way and
// turn of a loop lines up with turn; where another would have gone elsewhere can be seen in the condition.
#pragma once

#include "ir/evaluate.hpp"
#include "ir/stochastic_system.hpp"

namespace tidemark::ir {

struct Lockstep {
    Point<float> in_float{};
    Point<double> in_double{};
    Samples samples{};

    /// As a condition or a whole number: whether double or a sample would have it otherwise.
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
    /// What comes in from outside is exact.
    static Value exactly(const Point<float>& point) {
        return {point, {point.real, point.bits}, StochasticSystem::all(point)};
    }

    Value compute(Op op, Scalar result, Scalar of, const Operands<Value>& operands) {
        const Value a = op == Op::select ? exactly(operands.a.in_float) : operands.a; // it decides
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
