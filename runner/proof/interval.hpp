// Interval arithmetic with outward rounding: the result of an operation on any two numbers of the operands,
// in real arithmetic, lies in the resulting interval. Bounds are doubles. If an operation is not defined on
// the whole operand, `partial` is set and the bounds hold for the part on which it is defined.
//
// Sums, products, quotients and roots are rounded to nearest and widened by one step (S. M. Rump, P.
// Zimmermann, S. Boldo, G. Melquiond: Computing predecessor and successor in rounding to nearest, BIT 49,
// 2009). glibc documents errors of one or two units in the last place for its functions (GNU C Library
// manual, Errors in Math Functions); k_library_ulps leaves a margin.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tidemark::proof {

struct Interval {
    double low = 0;
    double high = 0;
    bool partial = false; ///< may also be NaN or infinite; finite results lie within the bounds
    /// If an operation jumps at a bound, its value there is the limit from within the interval.
    bool from_below = false; ///< at `high`
    bool from_above = false; ///< at `low`

    bool point() const { return low == high && !partial; }
    bool contains(double number) const { return low <= number && number <= high; }
    double width() const { return high - low; }
};

inline constexpr Interval k_one{1, 1};
inline constexpr double k_infinity = std::numeric_limits<double>::infinity();
inline constexpr int k_library_ulps = 3;

/// Returns a number one or two steps below `a`.
inline double below(double a) {
    constexpr double k_unit = std::numeric_limits<double>::epsilon() / 2;
    if (a == k_infinity)
        return std::numeric_limits<double>::max();
    if (a == -k_infinity)
        return a;
    return a - (k_unit * (1 + 2 * k_unit) * std::abs(a) + std::numeric_limits<double>::denorm_min());
}
inline double above(double a) {
    return -below(-a);
}

/// Returns a + b, rounded downwards. The rounding error of the sum in double is known exactly (D. E. Knuth:
/// The Art of Computer Programming 2, 4.2.2, theorem B), so an exact sum is not widened.
inline double sum_below(double a, double b) {
    const double sum = a + b;
    const double rest = sum - a;
    const double lost = (a - (sum - rest)) + (b - rest);
    return lost >= 0 ? sum : below(sum);
}

/// Returns whether the product in double is certainly exact: that holds for two floats, and for a power of
/// two.
inline bool is_exact_product(double a, double b, double product) {
    constexpr double k_smallest = 1e-290; // below this, the rounding error may itself underflow
    constexpr uint64_t k_fraction = (uint64_t{1} << 52) - 1, k_beyond_float = (uint64_t{1} << 29) - 1;
    const auto of_a = std::bit_cast<uint64_t>(a), of_b = std::bit_cast<uint64_t>(b);
    const bool floats = ((of_a | of_b) & k_beyond_float) == 0;
    return (floats || (of_a & k_fraction) == 0 || (of_b & k_fraction) == 0) && std::abs(product) > k_smallest;
}

/// Returns a b, rounded downwards. 0 * infinity is 0: an infinite bound stands for large numbers.
inline double product_below(double a, double b) {
    if (a == 0 || b == 0)
        return 0;
    const double product = a * b;
    return is_exact_product(a, b, product) ? product : below(product);
}

inline Interval everything(bool partial = true) {
    return {-k_infinity, k_infinity, partial};
}
/// Returns `a` with both bounds moved outwards by `steps` steps.
Interval widened(Interval a, int steps = 1);
Interval hull(const Interval& a, const Interval& b);
/// Intersects two bounds of the same number.
Interval intersection(const Interval& a, const Interval& b);

inline Interval operator-(const Interval& a) {
    return {-a.high, -a.low, a.partial};
}
inline Interval operator+(const Interval& a, const Interval& b) {
    const double low = sum_below(a.low, b.low), high = -sum_below(-a.high, -b.high);
    return std::isnan(low) || std::isnan(high) ? everything() : Interval{low, high, a.partial || b.partial};
}
inline Interval operator-(const Interval& a, const Interval& b) {
    return a + -b;
}

/// Returns the least product, rounded downwards; the signs select the bounds to multiply.
inline double least_product(const Interval& a, const Interval& b) {
    if (a.low >= 0)
        return product_below(b.low >= 0 ? a.low : a.high, b.low);
    if (a.high <= 0)
        return product_below(b.high <= 0 ? a.high : a.low, b.high);
    if (b.low >= 0)
        return product_below(a.low, b.high);
    if (b.high <= 0)
        return product_below(a.high, b.low);
    return std::min(product_below(a.low, b.high), product_below(a.high, b.low));
}
inline Interval operator*(const Interval& a, const Interval& b) {
    const double low = least_product(a, b), high = -least_product(-a, b);
    return std::isnan(low) || std::isnan(high) ? everything() : Interval{low, high, a.partial || b.partial};
}
Interval operator/(const Interval& a, const Interval& b);

inline Interval absolute(const Interval& a) {
    if (a.low >= 0)
        return a;
    if (a.high <= 0)
        return -a;
    return {0, std::max(-a.low, a.high), a.partial};
}
inline Interval square(const Interval& a) {
    const Interval size = absolute(a);
    return {product_below(size.low, size.low), -product_below(-size.high, size.high), a.partial};
}
inline Interval minimum(const Interval& a, const Interval& b) {
    const double low = std::min(a.low, b.low);
    if (a.partial || b.partial) // the minimum of NaN and a number may be the number
        return {low, std::max(a.partial ? b.high : a.high, b.partial ? a.high : b.high), true};
    return {low, std::min(a.high, b.high)};
}
inline Interval maximum(const Interval& a, const Interval& b) {
    return -minimum(-a, -b);
}
Interval sign(const Interval& a);
Interval sqrt(const Interval& a);
Interval inverse_sqrt(const Interval& a);
/// x - y floor(x / y)
Interval modulo(const Interval& a, const Interval& b);
Interval fract(const Interval& a);
/// y floor(x / y)
Interval whole_multiple(const Interval& a, const Interval& b);
/// x - y round(x / y): the signed distance to the nearest multiple
Interval nearest_rest(const Interval& a, const Interval& b);
Interval sin(const Interval& a);
Interval cos(const Interval& a);
Interval tan(const Interval& a);
Interval atan2(const Interval& a, const Interval& b);
Interval cosh(const Interval& a);
Interval pow(const Interval& a, const Interval& b);
/// a (1 - c) + b c, linear in each operand
Interval mix(const Interval& a, const Interval& b, const Interval& c);
/// a a (3 - 2 a), and a a a (a (6 a - 15) + 10). Both rise from 0 at 0 to 1 at 1.
Interval hermite(const Interval& a);
Interval quintic(const Interval& a);

/// Applies a non-decreasing function of the C library that is defined on [first, last].
Interval increasing(double (*function)(double), const Interval& a, double first = -k_infinity,
                    double last = k_infinity);

} // namespace tidemark::proof
