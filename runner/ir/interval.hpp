// Interval arithmetic with outward rounding: the result of an operation on any two numbers of the operands,
// in real arithmetic, lies in the result. Bounds are doubles. Where an operation is not defined on the whole
// of an operand, `partial` says so, and the bounds hold for the part where it is.
//
// Sums, products, quotients and roots are rounded to nearest and widened by one step (S. M. Rump,
// P. Zimmermann, S. Boldo, G. Melquiond: Computing predecessor and successor in rounding to nearest, BIT 49,
// 2009). glibc documents its functions to be off by one or two units in the last place (GNU C Library manual,
// Errors in Math Functions); k_library_ulps leaves room.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace tidemark::ir {

struct Interval {
    double low = 0;
    double high = 0;
    bool partial = false; ///< NaN or an infinity may come of it; what is a number lies within
    /// Where an operation jumps at a bound, it is taken as it comes there from within.
    bool from_below = false; ///< at `high`
    bool from_above = false; ///< at `low`

    bool point() const { return low == high && !partial; }
    bool contains(double number) const { return low <= number && number <= high; }
    double width() const { return high - low; }
};

inline constexpr double k_infinity = std::numeric_limits<double>::infinity();
inline constexpr int k_library_ulps = 3;

/// A number below `a`, by one or two steps.
double below(double a);
inline double above(double a) {
    return -below(-a);
}

inline Interval everything(bool partial = true) {
    return {-k_infinity, k_infinity, partial};
}
/// Both bounds pushed outwards `steps` times.
Interval widened(Interval a, int steps = 1);
Interval hull(const Interval& a, const Interval& b);
/// Of two bounds of one number.
Interval intersection(const Interval& a, const Interval& b);

Interval operator+(const Interval& a, const Interval& b);
Interval operator-(const Interval& a, const Interval& b);
Interval operator-(const Interval& a);
Interval operator*(const Interval& a, const Interval& b);
Interval operator/(const Interval& a, const Interval& b);

Interval square(const Interval& a);
Interval absolute(const Interval& a);
Interval minimum(const Interval& a, const Interval& b);
Interval maximum(const Interval& a, const Interval& b);
Interval sign(const Interval& a);
Interval sqrt(const Interval& a);
Interval inverse_sqrt(const Interval& a);
/// x - y floor(x / y); fract(x).
Interval modulo(const Interval& a, const Interval& b);
Interval fract(const Interval& a);
/// y floor(x / y).
Interval whole_multiple(const Interval& a, const Interval& b);
/// x - y round(x / y): how far it is to the nearest multiple.
Interval nearest_rest(const Interval& a, const Interval& b);
Interval sin(const Interval& a);
Interval cos(const Interval& a);
Interval tan(const Interval& a);
Interval atan2(const Interval& a, const Interval& b);
Interval cosh(const Interval& a);
Interval pow(const Interval& a, const Interval& b);
/// a (1 - c) + b c, linear in each of the three.
Interval mix(const Interval& a, const Interval& b, const Interval& c);
/// a a (3 - 2 a); a a a (a (6 a - 15) + 10). Both rise from 0 at 0 to 1 at 1.
Interval hermite(const Interval& a);
Interval quintic(const Interval& a);

/// A function of the C library that never falls, defined on [first, last].
Interval increasing(double (*function)(double), const Interval& a, double first = -k_infinity,
                    double last = k_infinity);

} // namespace tidemark::ir
