#include "ir/tangent_system.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace tidemark::ir {
namespace {

constexpr Interval k_two{2, 2};

Interval number(double value) {
    return {value, value};
}

/// Returns the derivative of a continuous function of one number; `value` is the function's value.
std::optional<Interval> derivative(Op op, const Interval& a, const Interval& value) {
    const auto hermite_factor = [&a] { return number(0.25) - square(a - number(0.5)); }; // a (1 - a)
    switch (op) {
    case Op::negate: return -k_one;
    case Op::square: return k_two * a;
    case Op::absolute: return hull(sign(number(a.low)), sign(number(a.high)));
    case Op::sqrt: return k_one / (k_two * value);
    case Op::inverse_sqrt: return number(-0.5) * value * square(value);
    case Op::sin: return cos(a);
    case Op::cos: return -sin(a);
    case Op::tan: return k_one + square(value);
    case Op::asin: return inverse_sqrt(k_one - square(a));
    case Op::acos: return -inverse_sqrt(k_one - square(a));
    case Op::atan: return k_one / (k_one + square(a));
    case Op::sinh: return cosh(a);
    case Op::cosh: return increasing(std::sinh, a);
    case Op::tanh: return k_one - square(value);
    case Op::asinh: return inverse_sqrt(k_one + square(a));
    case Op::acosh: return inverse_sqrt(square(a) - k_one);
    case Op::atanh: return k_one / (k_one - square(a));
    case Op::exp: return value;
    case Op::exp2: return value * widened(number(std::numbers::ln2));
    case Op::log: return k_one / a;
    case Op::log2: return k_one / (a * widened(number(std::numbers::ln2)));
    case Op::hermite: return number(6) * hermite_factor();
    case Op::quintic: return number(30) * square(hermite_factor());
    default: return std::nullopt;
    }
}

/// Returns whether the rounding operation gives a single whole number over the piece.
bool is_one_number(Op op, const Interval& a) {
    return IntervalSystem().compute(op, Scalar::real, Scalar::real, {a, {}, {}}).point();
}

Interval slope_at_jumps(Op op, const Interval& value, const Tangent& a, const Tangent& b, bool aside) {
    const Interval turns = b.value.point() && b.value.low > 0 ? a.value / b.value : everything();
    const auto rest = [&](Op jumps, const Interval& of) {
        return aside || is_one_number(jumps, of) ? a.slope : everything();
    };
    switch (op) {
    case Op::fract: return rest(Op::floor, a.value);
    case Op::modulo: return b.constant() ? rest(Op::floor, turns) : everything();
    case Op::nearest_rest: return b.constant() ? rest(Op::round, turns) : everything();
    case Op::remainder: return b.constant() ? rest(Op::truncate, turns) : everything();
    case Op::floor:
    case Op::ceil:
    case Op::truncate:
    case Op::round:
    case Op::round_even:
    case Op::sign: return aside || value.point() ? Interval{} : everything();
    default: return value.point() ? Interval{} : everything();
    }
}

Interval slope_of_smaller(const Tangent& a, const Tangent& b) {
    if (a.value.partial || b.value.partial)
        return everything();
    if (a.value.high < b.value.low)
        return a.slope;
    return b.value.high < a.value.low ? b.slope : hull(a.slope, b.slope);
}

Tangent negated(const Tangent& a) {
    return {-a.value, -a.slope};
}

Interval slope_of_power(const Interval& value, const Tangent& a, const Tangent& b) {
    if (b.constant())
        return b.value * pow(a.value, b.value - k_one) * a.slope;
    return value * (b.slope * increasing(std::log, a.value, 0) + b.value * a.slope / a.value);
}

Interval slope_of_product(const Tangent& a, const Tangent& b) {
    if (a.constant())
        return a.value * b.slope;
    return b.constant() ? a.slope * b.value : a.slope * b.value + a.value * b.slope;
}

Interval slope_of(Op op, const Interval& value, const Tangent& a, const Tangent& b, const Tangent& c,
                  bool aside) {
    switch (op) {
    case Op::add: return b.constant() ? a.slope : a.constant() ? b.slope : a.slope + b.slope;
    case Op::subtract: return b.constant() ? a.slope : a.slope - b.slope;
    case Op::multiply: return slope_of_product(a, b);
    case Op::divide: return (a.slope - value * b.slope) / b.value;
    case Op::minimum: return slope_of_smaller(a, b);
    case Op::maximum: return -slope_of_smaller(negated(a), negated(b));
    case Op::atan2:
        if (a.value.contains(0) && b.value.low <= 0)
            return everything();
        return (b.value * a.slope - a.value * b.slope) / (square(a.value) + square(b.value));
    case Op::pow: return slope_of_power(value, a, b);
    case Op::mix: return a.slope * (k_one - c.value) + b.slope * c.value + (b.value - a.value) * c.slope;
    case Op::select: {
        const auto way = IntervalSystem::decide(a.value);
        if (!way)
            return aside ? hull(b.slope, c.slope) : everything();
        return *way ? b.slope : c.slope;
    }
    case Op::narrowed: return intersection(a.slope, b.slope);
    default: break;
    }
    if (const auto factor = derivative(op, a.value, value))
        return *factor * a.slope;
    return slope_at_jumps(op, value, a, b, aside);
}

} // namespace

Tangent TangentSystem::compute(Op op, Scalar result, Scalar of, const Operands<Tangent>& operands) const {
    const auto& [a, b, c] = operands;
    const Interval value = IntervalSystem().compute(op, result, of, {a.value, b.value, c.value});
    if (value.point() && op != Op::narrowed)
        return {value, {}};
    if (op == Op::select)
        return {value, slope_of(op, value, a, b, c, jumps_aside)};
    if (result != Scalar::real || of != Scalar::real) // whole numbers change only by jumps
        return {value, jumps_aside && op != Op::bits_as ? Interval{} : everything()};
    const bool constant = a.constant() && b.constant() && c.constant();
    return {value, constant ? Interval{} : slope_of(op, value, a, b, c, jumps_aside)};
}

} // namespace tidemark::ir
