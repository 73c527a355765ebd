#include "proof/interval.hpp"

#include <array>
#include <utility>

namespace tidemark::proof {
namespace {

constexpr double k_pi = 3.141592653589793;
/// Beyond this angle, multiples of a quarter turn are not distinguished.
constexpr double k_largest_angle = 1e9;
/// Beyond this number, not every whole number is a double.
constexpr double k_largest_whole = 4503599627370496; // 2^52

Interval of_corners(const std::array<double, 4>& corners, bool is_partial) {
    const auto [low, high] = std::ranges::minmax(corners);
    if (std::ranges::any_of(corners, [](double each) { return std::isnan(each); }))
        return everything();
    return {below(low), above(high), is_partial};
}

/// Returns whether a + 2 pi k, with `angle` as a, may lie in the interval for some whole k.
bool contains_angle(const Interval& interval, double angle) {
    const double slack = 1e-15 * std::max(std::abs(interval.low), std::abs(interval.high)) + 1e-15;
    const double turns = std::ceil((interval.low - slack - angle) / (2 * k_pi) - 1e-12);
    return turns * 2 * k_pi + angle <= interval.high + slack + 1e-9;
}

Interval wave(double (*function)(double), const Interval& a, double top) {
    if (!(a.low > -k_largest_angle && a.high < k_largest_angle) || a.high - a.low >= 2 * k_pi)
        return {-1, 1, a.partial || std::isinf(a.low) || std::isinf(a.high)};
    const double one = function(a.low), other = function(a.high);
    Interval result = widened({std::min(one, other), std::max(one, other), a.partial}, k_library_ulps);
    if (contains_angle(a, top))
        result.high = 1;
    if (contains_angle(a, top + k_pi))
        result.low = -1;
    return {std::max(result.low, -1.0), std::min(result.high, 1.0), a.partial};
}

/// Returns the largest whole k with k b <= a. fma gives the exact sign of k b - a.
double whole_multiples(double a, double b) {
    double k = std::floor(a / b);
    if (std::fma(k, b, -a) > 0)
        k -= 1;
    if (std::fma(k + 1, b, -a) <= 0)
        k += 1;
    return k;
}

} // namespace

Interval widened(Interval a, int steps) {
    for (int i = 0; i < steps; ++i) {
        a.low = below(a.low);
        a.high = above(a.high);
    }
    return a;
}

Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high), a.partial || b.partial};
}

Interval intersection(const Interval& a, const Interval& b) {
    const Interval both{std::max(a.low, b.low), std::min(a.high, b.high), a.partial && b.partial};
    return a.point() || both.low > both.high ? a : both; // the text's own float may be off by one rounding
}

/// Returns a / b if 0 is a bound of b: the quotient is unbounded on one side.
static Interval beside_pole(const Interval& a, const Interval& b) {
    if (b.high == 0)
        return beside_pole(-a, -b);
    return {a.low >= 0 ? std::max(0.0, below(a.low / b.high)) : -k_infinity,
            a.high <= 0 ? std::min(0.0, above(a.high / b.high)) : k_infinity, true};
}

Interval operator/(const Interval& a, const Interval& b) {
    if ((b.low < 0 && b.high > 0) || (b.low == 0 && b.high == 0))
        return everything();
    if (b.low == 0 || b.high == 0)
        return beside_pole(a, b);
    if (b.high < 0)
        return -a / -b;
    Interval quotient =
        of_corners({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high}, a.partial || b.partial);
    if (a.low >= 0)
        quotient.low = std::max(quotient.low, 0.0);
    if (a.high <= 0)
        quotient.high = std::min(quotient.high, 0.0);
    return quotient;
}

Interval sign(const Interval& a) {
    const auto of = [](double number) { return double(number > 0) - double(number < 0); };
    return {of(a.low), of(a.high), a.partial};
}

Interval sqrt(const Interval& a) {
    if (a.high < 0)
        return everything();
    const double low = a.low <= 0 ? 0 : std::max(0.0, below(std::sqrt(a.low)));
    return {low, above(std::sqrt(a.high)), a.partial || a.low < 0};
}

Interval inverse_sqrt(const Interval& a) {
    if (a.high <= 0)
        return everything();
    const double high = a.low <= 0 ? k_infinity : above(above(1 / std::sqrt(a.low)));
    return {std::max(0.0, below(below(1 / std::sqrt(a.high)))), high, a.partial || a.low <= 0};
}

/// Returns the least and the largest floor(x / b) for x in the interval, b > 0. Multiples are exact in double
/// as long as b is a float and the factor is small.
static std::pair<double, double> multiples_in(const Interval& a, double b) {
    double last = whole_multiples(a.high, b);
    if (a.from_below && std::fma(last, b, -a.high) == 0)
        last -= 1;
    return {whole_multiples(a.low, b), last};
}

static Interval modulo_by(const Interval& a, double b) {
    const auto [first, last] = multiples_in(a, b);
    if (!(std::abs(first) < k_largest_whole) || first < last)
        return {0, b, a.partial};
    const Interval rest = a - Interval{b, b} * Interval{first, first};
    return {std::max(rest.low, 0.0), std::min(rest.high, b), a.partial};
}

Interval modulo(const Interval& a, const Interval& b) {
    if (b.contains(0) || std::isinf(a.low) || std::isinf(a.high))
        return everything();
    if (b.point())
        return b.low > 0 ? modulo_by(a, b.low) : -modulo_by(-a, -b.low);
    const Interval turns = a / b;
    const double first = std::floor(turns.low);
    if (std::isfinite(first) && first == std::floor(turns.high))
        return a - b * Interval{first, first};
    return {std::min(b.low, 0.0), std::max(b.high, 0.0), a.partial || b.partial};
}

Interval whole_multiple(const Interval& a, const Interval& b) {
    const bool countable = b.point() && b.low > 0 && absolute(a).high / b.low < k_largest_whole;
    if (!countable)
        return a - modulo(a, b);
    const auto [first, last] = multiples_in(a, b.low);
    const double low = first * b.low, high = last * b.low;
    const bool exact = std::fma(first, b.low, -low) == 0 && std::fma(last, b.low, -high) == 0;
    return widened({low, high, a.partial}, exact ? 0 : 1);
}

Interval nearest_rest(const Interval& a, const Interval& b) {
    if (!b.point() || b.low <= 0)
        return everything(a.partial || b.partial || b.contains(0));
    const Interval half{b.low / 2, b.low / 2};
    Interval moved = a + half; // x modulo y, shifted to begin at -y / 2
    moved.from_below = a.from_below;
    return modulo(moved, b) - half;
}

Interval fract(const Interval& a) {
    const double whole = std::floor(a.low);
    if (std::isfinite(whole) && (whole == std::floor(a.high) || (a.from_below && whole + 1 == a.high)))
        return {std::max(0.0, below(a.low - whole)), std::min(1.0, above(a.high - whole)), a.partial};
    return {0, 1, a.partial || std::isinf(a.low) || std::isinf(a.high)};
}

Interval sin(const Interval& a) {
    return wave(std::sin, a, k_pi / 2);
}

Interval cos(const Interval& a) {
    return wave(std::cos, a, 0);
}

Interval tan(const Interval& a) {
    const bool near = a.low > -k_largest_angle && a.high < k_largest_angle && a.high - a.low < k_pi;
    if (!near || contains_angle(a, k_pi / 2) || contains_angle(a, -k_pi / 2))
        return everything();
    return increasing(std::tan, a);
}

/// On each side of the cut (the negative x axis) it is monotonic along the edges of the box, so its extremes
/// are at corners.
Interval atan2(const Interval& a, const Interval& b) {
    const bool above_cut = a.from_above && a.low == 0 && b.high < 0;
    const bool below_cut = a.from_below && a.high == 0 && b.high < 0;
    if (a.contains(0) && b.low <= 0 && !above_cut && !below_cut)
        return {below(-k_pi), above(k_pi), a.partial || b.partial || b.high >= 0};
    const double a_low = above_cut ? 0.0 : a.low, a_high = below_cut ? -0.0 : a.high;
    const std::array<double, 4> corners{std::atan2(a_low, b.low), std::atan2(a_low, b.high),
                                        std::atan2(a_high, b.low), std::atan2(a_high, b.high)};
    const auto [low, high] = std::ranges::minmax(corners);
    return widened({low, high, a.partial || b.partial}, k_library_ulps);
}

Interval cosh(const Interval& a) {
    const Interval size = absolute(a);
    Interval result = widened({std::cosh(size.low), std::cosh(size.high), a.partial}, k_library_ulps);
    result.low = std::max(result.low, 1.0);
    return result;
}

/// For a positive base it is monotonic in each operand.
Interval pow(const Interval& a, const Interval& b) {
    if (a.high < 0)
        return everything();
    const double base = a.low > 0 ? a.low : 0.0; // -0 has different powers
    const bool undefined = a.low < 0 || (base == 0 && b.low <= 0);
    const std::array<double, 4> corners{std::pow(base, b.low), std::pow(base, b.high),
                                        std::pow(a.high, b.low), std::pow(a.high, b.high)};
    Interval result = of_corners(corners, a.partial || b.partial || undefined);
    result = widened(result, k_library_ulps - 1);
    result.low = std::max(result.low, 0.0);
    return result;
}

Interval mix(const Interval& a, const Interval& b, const Interval& c) {
    const auto at = [&](double part) {
        const Interval share{part, part};
        return a * (Interval{1, 1} - share) + b * share;
    };
    if (std::isinf(c.low) || std::isinf(c.high))
        return everything();
    Interval result = hull(at(c.low), at(c.high));
    result.partial = result.partial || c.partial;
    return result;
}

namespace {

/// Bounds a polynomial that rises from 0 at 0 to 1 at 1.
template <class Polynomial>
Interval rising(const Interval& a, Polynomial polynomial) {
    if (a.low < 0 || a.high > 1)
        return polynomial(a);
    const Interval low = polynomial({a.low, a.low}), high = polynomial({a.high, a.high});
    return {std::max(0.0, low.low), std::min(1.0, high.high), a.partial};
}

} // namespace

Interval hermite(const Interval& a) {
    return rising(a, [](const Interval& x) { return square(x) * (Interval{3, 3} - Interval{2, 2} * x); });
}

Interval quintic(const Interval& a) {
    return rising(a, [](const Interval& x) {
        return square(x) * x * (x * (x * Interval{6, 6} - Interval{15, 15}) + Interval{10, 10});
    });
}

Interval increasing(double (*function)(double), const Interval& a, double first, double last) {
    if (a.high < first || a.low > last)
        return everything();
    const double low = function(std::max(a.low, first)), high = function(std::min(a.high, last));
    const Interval result{low, high,
                          a.partial || a.low < first || a.high > last || std::isinf(low) || std::isinf(high)};
    return widened(result, k_library_ulps);
}

} // namespace tidemark::proof
