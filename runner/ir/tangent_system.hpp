// The number system of intervals with a derivative: bounds of a value over a piece of a ray, and of its slope
// along the ray (R. E. Moore: Interval Analysis, 1966; forward mode). At a kink, of abs() or min(), the
// slopes of both sides are included (F. H. Clarke: Optimization and Nonsmooth Analysis, 1983), so the mean
// value theorem holds; if the value may jump, the slope is unbounded.
#pragma once

#include "ir/interval_system.hpp"

namespace tidemark::ir {

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
        return {ir::hull(a.value, b.value), jumps_aside ? ir::hull(a.slope, b.slope) : everything()};
    }
    static std::optional<std::pair<Value, Value>> split(Op, const Operands<Value>&) { return std::nullopt; }
    static bool may_be_split(const Value&) { return false; }
};

} // namespace tidemark::ir
