#include "proof/number_systems.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace tidemark::proof {
namespace {

constexpr Interval k_either{0, 1};

Interval all_of(Scalar type) {
    switch (type) {
    case Scalar::real: return everything();
    case Scalar::signed_int: return {-2147483648.0, 2147483647.0};
    case Scalar::unsigned_int: return {0, 4294967295.0};
    case Scalar::boolean: return k_either;
    }
    return everything();
}

/// Returns whether the interval is one number that the device can represent: a real number has to be a float.
bool is_exact(const Interval& a, Scalar type) {
    return a.point() && (type != Scalar::real || double(float(a.low)) == a.low);
}

Point<float> point_of(const Interval& a, Scalar type) {
    if (type == Scalar::real)
        return {float(a.low), 0};
    return {0, uint32_t(int64_t(a.low))};
}

Interval interval_of(const Point<float>& a, Scalar type) {
    if (type == Scalar::real)
        return std::isfinite(a.real) ? Interval{a.real, a.real} : everything();
    const double number = type == Scalar::signed_int ? double(int32_t(a.bits)) : double(a.bits);
    return {number, number};
}

/// Returns a boolean as an interval of 0 and 1: true, false, or either.
Interval truth(bool always, bool never) {
    return {always ? 1.0 : 0.0, never ? 0.0 : 1.0};
}

Interval less(const Interval& a, const Interval& b, bool equal_too) {
    if (a.partial || b.partial)
        return k_either;
    const bool always = equal_too ? a.high <= b.low : a.high < b.low;
    const bool never = equal_too ? a.low > b.high : a.low >= b.high;
    return truth(always, never);
}

Interval equal(const Interval& a, const Interval& b) {
    if (a.partial || b.partial)
        return k_either;
    return truth(a.point() && b.point() && a.low == b.low, a.high < b.low || b.high < a.low);
}

Interval negated(const Interval& a) {
    return {1 - a.high, 1 - a.low};
}

/// Rounds both bounds to whole numbers.
template <class Rounding>
Interval rounded(const Interval& a, Rounding rounding) {
    return {rounding(a.low), rounding(a.high), a.partial || std::isinf(a.low) || std::isinf(a.high)};
}

Interval floor(const Interval& a) {
    Interval result = rounded(a, [](double x) { return std::floor(x); });
    if (a.from_below && result.high == a.high && result.low < result.high)
        result.high -= 1;
    return result;
}

Interval ceil(const Interval& a) {
    Interval result = rounded(a, [](double x) { return std::ceil(x); });
    if (a.from_above && result.low == a.low && result.low < result.high)
        result.low += 1;
    return result;
}

bool is_half(double a) {
    return std::abs(a - std::trunc(a)) == 0.5;
}

template <class Rounding>
Interval to_nearest(const Interval& a, Rounding rounding) {
    Interval result = rounded(a, rounding);
    if (a.from_below && is_half(a.high))
        result.high = a.high - 0.5;
    if (a.from_above && is_half(a.low))
        result.low = a.low + 0.5;
    return result;
}

Interval logical(Op op, const Interval& a, const Interval& b, const Interval& c) {
    switch (op) {
    case Op::logical_and: return minimum(a, b);
    case Op::logical_or: return maximum(a, b);
    case Op::logical_not: return negated(a);
    case Op::equal: return equal(a, b);
    case Op::not_equal: return negated(equal(a, b));
    case Op::select: break;
    default: return k_either;
    }
    if (a.low == a.high)
        return a.low != 0 ? b : c;
    return hull(b, c);
}

/// Bounds bitwise operations on numbers that are not negative; other operands give the type's whole range.
Interval bits(Op op, Scalar type, const Interval& a, const Interval& b) {
    if (a.low < 0 || b.low < 0)
        return all_of(type);
    const auto ones = [](double number) { return double(std::bit_ceil(uint64_t(number) + 1) - 1); };
    switch (op) {
    case Op::bit_and: return {0, std::min(a.high, b.high)};
    case Op::bit_or: return {std::max(a.low, b.low), ones(std::max(a.high, b.high))};
    case Op::bit_xor: return {0, ones(std::max(a.high, b.high))};
    case Op::shift_right: {
        if (!b.point() || b.low > 31)
            return all_of(type);
        const double unit = std::ldexp(1, int(b.low));
        return {std::floor(a.low / unit), std::floor(a.high / unit)};
    }
    default: return all_of(type);
    }
}

Interval whole(Op op, Scalar type, const Interval& a, const Interval& b) {
    const auto within = [type](const Interval& result) {
        const Interval all = all_of(type);
        return result.low >= all.low && result.high <= all.high ? result : all;
    };
    switch (op) { // sums below 2^53 are exact in double
    case Op::add: return within({a.low + b.low, a.high + b.high});
    case Op::subtract: return within({a.low - b.high, a.high - b.low});
    case Op::multiply: return within(rounded(a * b, [](double x) { return std::round(x); }));
    case Op::negate: return within(-a);
    case Op::square: return within(rounded(square(a), [](double x) { return std::round(x); }));
    case Op::absolute: return within(absolute(a)); // on a device the least int has no absolute value
    case Op::minimum: return minimum(a, b);
    case Op::maximum: return maximum(a, b);
    case Op::less: return less(a, b, false);
    case Op::less_equal: return less(a, b, true);
    case Op::equal: return equal(a, b);
    case Op::not_equal: return negated(equal(a, b));
    default: return within(bits(op, type, a, b));
    }
}

Interval real(Op op, const Interval& a, const Interval& b, const Interval& c) {
    switch (op) {
    case Op::add: return a + b;
    case Op::subtract: return a - b;
    case Op::multiply: return a * b;
    case Op::divide: return a / b;
    case Op::modulo: return modulo(a, b);
    case Op::negate: return -a;
    case Op::square: return square(a);
    case Op::absolute: return absolute(a);
    case Op::sign: return sign(a);
    case Op::minimum: return minimum(a, b);
    case Op::maximum: return maximum(a, b);
    case Op::floor: return floor(a);
    case Op::ceil: return ceil(a);
    case Op::truncate: return rounded(a, [](double x) { return std::trunc(x); });
    case Op::round: return to_nearest(a, [](double x) { return std::round(x); });
    case Op::round_even: return to_nearest(a, [](double x) { return std::nearbyint(x); });
    case Op::fract: return fract(a);
    case Op::nearest_rest: return nearest_rest(a, b);
    case Op::whole_multiple: return whole_multiple(a, b);
    case Op::sqrt: return sqrt(a);
    case Op::inverse_sqrt: return inverse_sqrt(a);
    case Op::sin: return sin(a);
    case Op::cos: return cos(a);
    case Op::tan: return tan(a);
    case Op::asin: return increasing(std::asin, a, -1, 1);
    case Op::acos: return -increasing([](double x) { return -std::acos(x); }, a, -1, 1);
    case Op::atan: return increasing(std::atan, a);
    case Op::atan2: return atan2(a, b);
    case Op::sinh: return increasing(std::sinh, a);
    case Op::cosh: return cosh(a);
    case Op::tanh: return increasing(std::tanh, a);
    case Op::asinh: return increasing(std::asinh, a);
    case Op::acosh: return increasing(std::acosh, a, 1);
    case Op::atanh: return increasing(std::atanh, a, -1, 1);
    case Op::exp: return increasing(std::exp, a);
    case Op::exp2: return increasing(std::exp2, a);
    case Op::log: return increasing(std::log, a, 0);
    case Op::log2: return increasing(std::log2, a, 0);
    case Op::pow: return pow(a, b);
    case Op::mix: return mix(a, b, c);
    case Op::hermite: return hermite(a);
    case Op::quintic: return quintic(a);
    case Op::narrowed: return intersection(a, b);
    case Op::less: return less(a, b, false);
    case Op::less_equal: return less(a, b, true);
    case Op::equal: return equal(a, b);
    case Op::not_equal: return negated(equal(a, b));
    case Op::is_nan:
    case Op::is_inf: return a.partial ? k_either : Interval{0, 0};
    default: return everything();
    }
}

Interval to_int(const Interval& a, Scalar type) {
    const Interval whole = rounded(a, [](double x) { return std::trunc(x); });
    const Interval all = all_of(type);
    return !whole.partial && whole.low >= all.low && whole.high <= all.high ? whole : all;
}

/// Converts between whole numbers that both types have, and from the bits of positive floats, which increase
/// with the float.
Interval bits_as(const Interval& a, Scalar of, Scalar result) {
    constexpr double k_first_infinite = 0x7f800000;
    if (of == Scalar::real || a.low < 0 || a.high >= k_first_infinite)
        return all_of(result);
    if (result != Scalar::real)
        return a;
    const auto number = [](double bits) { return double(std::bit_cast<float>(uint32_t(bits))); };
    return {number(a.low), number(a.high)};
}

/// Places where an operation jumps on its operand: first + k unit for every whole k, or at `first` alone if
/// `unit` is 0. The flags say whether the value at the jump differs from the values below and above it.
struct Jumps {
    double first = 0, unit = 1;
    bool from_below = true, from_above = false;
};

std::optional<Jumps> jumps_of(Op op, const Interval& period) {
    switch (op) {
    case Op::floor:
    case Op::fract: return Jumps{};
    case Op::ceil: return Jumps{0, 1, false, true};
    case Op::round:
    case Op::round_even: return Jumps{0.5, 1, true, true};
    case Op::modulo:
    case Op::whole_multiple:
    case Op::nearest_rest:
        if (period.point() && period.low != 0) {
            const double unit = std::abs(period.low);
            const bool nearest = op == Op::nearest_rest, negative = period.low < 0;
            return Jumps{nearest ? unit / 2 : 0, unit, nearest || !negative, nearest || negative};
        }
        return std::nullopt;
    case Op::atan2: // from pi to -pi
        if (period.high < 0)
            return Jumps{0, 0};
        return std::nullopt;
    default: return std::nullopt;
    }
}

/// Returns the only jump within the interval, or at a bound of it if the value at the bound differs from
/// those beside it; nullopt if there is none or more than one.
std::optional<double> jump_in(const Interval& a, const Jumps& jumps) {
    const bool at_low = jumps.from_above && !a.from_above, at_high = jumps.from_below && !a.from_below;
    const auto inside = [&](double at) {
        return (at_low ? at >= a.low : at > a.low) && (at_high ? at <= a.high : at < a.high);
    };
    if (jumps.unit == 0)
        return inside(jumps.first) ? std::optional(jumps.first) : std::nullopt;
    double at = std::ceil((a.low - jumps.first) / jumps.unit) * jumps.unit + jumps.first;
    if (!inside(at))
        at += jumps.unit;
    return inside(at) && !inside(at + jumps.unit) ? std::optional(at) : std::nullopt;
}

} // namespace

Interval IntervalSystem::constant(uint32_t bits, Scalar type) {
    return interval_of(PointSystem<float>::constant(bits, type), type);
}

Interval IntervalSystem::number(double real) {
    return std::isfinite(real) ? Interval{real, real} : everything();
}

Interval IntervalSystem::compute(Op op, Scalar result, Scalar of, const Operands<Interval>& operands) const {
    const auto& [a, b, c] = operands;
    const Scalar of_others = op == Op::select ? result : op == Op::ldexp ? Scalar::signed_int : of;
    if (is_exact(a, of) && is_exact(b, of_others) && is_exact(c, of_others))
        return interval_of(
            PointSystem<float>().compute(op, result, of,
                                         {point_of(a, of), point_of(b, of_others), point_of(c, of_others)}),
            result);
    if (op == Op::to_int)
        return to_int(a, result);
    if (op == Op::bits_as)
        return bits_as(a, of, result);
    if (op == Op::ldexp)
        return all_of(result);
    if (of == Scalar::real)
        return real(op, a, b, c);
    if (op == Op::to_real || op == Op::select || of == Scalar::boolean)
        return op == Op::to_real ? a : logical(op, a, b, c);
    const Interval answer = whole(op, of, a, b);
    return result == Scalar::boolean ? Interval{std::max(answer.low, 0.0), std::min(answer.high, 1.0)}
                                     : answer;
}

std::optional<bool> IntervalSystem::decide(const Interval& condition) {
    return condition.low == condition.high ? std::optional(condition.low != 0) : std::nullopt;
}

std::pair<int64_t, int64_t> IntervalSystem::range(const Interval& index) {
    return {int64_t(index.low), int64_t(index.high)};
}

std::optional<std::pair<Interval, Interval>> IntervalSystem::split(Op op,
                                                                   const Operands<Interval>& operands) {
    const Interval& a = operands.a;
    const auto jumps = jumps_of(op, operands.b);
    if (!jumps || a.partial || !(a.width() > 0 && a.width() < 1e9))
        return std::nullopt;
    const auto at = jump_in(a, *jumps);
    if (!at)
        return std::nullopt;
    return std::pair{Interval{a.low, *at, false, true, a.from_above},
                     Interval{*at, a.high, false, a.from_below, true}};
}

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
    default: return rounded(proof::real_number<double>(op, a, b, c));
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

} // namespace tidemark::proof
