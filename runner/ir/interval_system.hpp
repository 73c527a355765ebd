// The number system of intervals: the results of the text in real arithmetic for all numbers of its operands.
// An operand of a single number is one of the scene's floats; results of such operands alone are computed in
// float, as a driver does, so hashes of lattice points equal the scene's. Whole numbers and booleans are
// intervals, too.
#pragma once

#include "ir/interval.hpp"
#include "ir/point.hpp"

namespace tidemark::ir {

class IntervalSystem {
public:
    using Value = Interval;

    static Value constant(uint32_t bits, Scalar type);
    static Value number(double real);
    static Value unknown() { return everything(); }

    Value compute(Op op, Scalar result, Scalar of, const Operands<Value>& operands) const;

    static std::optional<bool> decide(const Value& condition);
    static std::pair<int64_t, int64_t> range(const Value& index);
    static Value hull(const Value& a, const Value& b) { return ir::hull(a, b); }
    static std::optional<std::pair<Value, Value>> split(Op op, const Operands<Value>& operands);
    static bool may_be_split(const Value& number) { return !number.point(); }
};

} // namespace tidemark::ir
