// GLSL's operations on whole numbers and their bits. Results that the language leaves undefined are those of
// drivers on a CPU: shifts use the lowest five bits, a division by zero gives all bits set.
#pragma once

#include "proof/function.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace tidemark::proof {

inline uint32_t divided(uint32_t a, uint32_t b, bool is_signed) {
    if (b == 0)
        return ~0u;
    if (!is_signed)
        return a / b;
    return b == ~0u ? 0u - a : uint32_t(int32_t(a) / int32_t(b));
}

/// The result has the sign of a.
inline uint32_t remainder_of(uint32_t a, uint32_t b, bool is_signed) {
    return b == 0 ? ~0u : a - b * divided(a, b, is_signed);
}

inline uint32_t modulo_of(uint32_t a, uint32_t b, bool is_signed) {
    const uint32_t rest = remainder_of(a, b, is_signed);
    const bool other_sign = is_signed && rest != 0 && b != 0 && (int32_t(rest) < 0) != (int32_t(b) < 0);
    return other_sign ? rest + b : rest;
}

inline uint32_t reversed(uint32_t a) {
    uint32_t result = 0;
    for (int i = 0; i < 32; ++i, a >>= 1)
        result = result << 1 | (a & 1);
    return result;
}

inline uint32_t highest_bit(uint32_t a, bool is_signed) {
    const uint32_t seen = is_signed && int32_t(a) < 0 ? ~a : a;
    return uint32_t(31 - std::countl_zero(seen)); // -1 if there is none
}

/// `type` is that of the operands. For booleans, 1 is true.
inline uint32_t whole_number(Op op, Scalar type, uint32_t a, uint32_t b, uint32_t c) {
    const bool is_signed = type == Scalar::signed_int;
    const bool less = is_signed ? int32_t(a) < int32_t(b) : a < b;
    switch (op) {
    case Op::add: return a + b;
    case Op::subtract: return a - b;
    case Op::multiply: return a * b;
    case Op::divide: return divided(a, b, is_signed);
    case Op::modulo: return modulo_of(a, b, is_signed);
    case Op::remainder: return remainder_of(a, b, is_signed);
    case Op::negate: return 0u - a;
    case Op::square: return a * a;
    case Op::absolute: return int32_t(a) < 0 ? 0u - a : a;
    case Op::sign: return int32_t(a) < 0 ? ~0u : a != 0;
    case Op::minimum: return less ? a : b;
    case Op::maximum: return less ? b : a;
    case Op::bit_and: return a & b;
    case Op::bit_or: return a | b;
    case Op::bit_xor: return a ^ b;
    case Op::bit_not: return ~a;
    case Op::shift_left: return a << (b & 31);
    case Op::shift_right: return is_signed ? uint32_t(int32_t(a) >> (b & 31)) : a >> (b & 31);
    case Op::bit_count: return uint32_t(std::popcount(a));
    case Op::reverse_bits: return reversed(a);
    case Op::lowest_bit: return a == 0 ? ~0u : uint32_t(std::countr_zero(a));
    case Op::highest_bit: return highest_bit(a, is_signed);
    case Op::less: return less;
    case Op::less_equal: return less || a == b;
    case Op::equal: return a == b;
    case Op::not_equal: return a != b;
    case Op::logical_and: return a & b;
    case Op::logical_or: return a | b;
    case Op::logical_not: return a ^ 1;
    case Op::select: return a ? b : c;
    default: return a; // bits_as
    }
}

// The number system of points: one value for a real number, in float (the driver's result, except for its own
// sine and similar functions) or in double (the same text without most of the rounding). Whole numbers and
// booleans are exact.

template <class Real>
struct Point {
    Real real = 0;
    uint32_t bits = 0; ///< of a whole number or a boolean
};

/// Returns the part of a real number above its floor, always below 1 as GLSL requires.
template <class Real>
Real fract(Real a) {
    const Real part = a - std::floor(a);
    return part < 1 ? part : std::nextafter(Real(1), Real(0));
}

/// Rounds towards zero and clamps to the type's range; NaN gives 0.
template <class Real>
uint32_t to_int(Real a, bool is_signed) {
    if (std::isnan(a))
        return 0;
    const double low = is_signed ? -2147483648.0 : 0, high = is_signed ? 2147483647.0 : 4294967295.0;
    const double inside = std::min(std::max(std::trunc(double(a)), low), high);
    return is_signed ? uint32_t(int32_t(inside)) : uint32_t(inside);
}

/// Computes the operations on real numbers that result in one.
template <class Real>
Real real_number(Op op, Real a, Real b, Real c) {
    switch (op) {
    case Op::add: return a + b;
    case Op::subtract: return a - b;
    case Op::multiply: return a * b;
    case Op::divide: return a / b;
    case Op::modulo: return a - b * std::floor(a / b);
    case Op::remainder: return a - b * std::trunc(a / b);
    case Op::negate: return -a;
    case Op::square: return a * a;
    case Op::absolute: return std::abs(a);
    case Op::sign: return Real(a > 0) - Real(a < 0);
    case Op::minimum: return std::fmin(a, b); // drivers prefer the operand that is not NaN
    case Op::maximum: return std::fmax(a, b);
    case Op::floor: return std::floor(a);
    case Op::ceil: return std::ceil(a);
    case Op::truncate: return std::trunc(a);
    case Op::round: return std::round(a);
    case Op::round_even: return std::nearbyint(a);
    case Op::fract: return fract(a);
    case Op::whole_multiple: return b * std::floor(a / b);
    case Op::nearest_rest: return a - b * std::round(a / b);
    case Op::sqrt: return std::sqrt(a);
    case Op::inverse_sqrt: return 1 / std::sqrt(a);
    case Op::sin: return std::sin(a);
    case Op::cos: return std::cos(a);
    case Op::tan: return std::tan(a);
    case Op::asin: return std::asin(a);
    case Op::acos: return std::acos(a);
    case Op::atan: return std::atan(a);
    case Op::atan2: return std::atan2(a, b);
    case Op::sinh: return std::sinh(a);
    case Op::cosh: return std::cosh(a);
    case Op::tanh: return std::tanh(a);
    case Op::asinh: return std::asinh(a);
    case Op::acosh: return std::acosh(a);
    case Op::atanh: return std::atanh(a);
    case Op::exp: return std::exp(a);
    case Op::exp2: return std::exp2(a);
    case Op::log: return std::log(a);
    case Op::log2: return std::log2(a);
    case Op::pow: return a < 0 ? std::numeric_limits<Real>::quiet_NaN() : std::pow(a, b);
    case Op::mix: return a * (1 - c) + b * c;
    case Op::hermite: return a * a * (3 - 2 * a);
    case Op::quintic: return a * a * a * (a * (a * 6 - 15) + 10);
    default: return a;
    }
}

template <class Real>
class PointSystem {
public:
    using Value = Point<Real>;

    static Value constant(uint32_t bits, Scalar type) {
        return type == Scalar::real ? Value{Real(std::bit_cast<float>(bits)), 0} : Value{0, bits};
    }
    static Value whole(uint32_t bits) { return {0, bits}; }
    static Value unknown() { return {std::numeric_limits<Real>::quiet_NaN(), 0}; }

    /// `of` is the type of the first operand.
    Value compute(Op op, Scalar result, Scalar of, const Operands<Value>& operands) const {
        const auto& [a, b, c] = operands;
        switch (op) {
        case Op::select: return a.bits ? b : c;
        case Op::to_real: return {of == Scalar::signed_int ? Real(int32_t(a.bits)) : Real(a.bits), 0};
        case Op::to_int: return whole(to_int(a.real, result == Scalar::signed_int));
        case Op::bits_as: return bits_as(result, of, a);
        case Op::ldexp: return {std::ldexp(a.real, int(b.bits)), 0};
        default: break;
        }
        if (of != Scalar::real)
            return whole(whole_number(op, of, a.bits, b.bits, c.bits));
        switch (op) {
        case Op::less: return whole(a.real < b.real);
        case Op::less_equal: return whole(a.real <= b.real);
        case Op::equal: return whole(a.real == b.real);
        case Op::not_equal: return whole(a.real != b.real);
        case Op::is_nan: return whole(std::isnan(a.real));
        case Op::is_inf: return whole(std::isinf(a.real));
        default: return {real_number(op, a.real, b.real, c.real), 0};
        }
    }

    static std::optional<bool> decide(const Value& condition) { return condition.bits != 0; }
    /// Returns the lowest and highest value it may have, as a signed number.
    static std::pair<int64_t, int64_t> range(const Value& index) {
        return {int32_t(index.bits), int32_t(index.bits)};
    }
    static Value hull(const Value& a, const Value&) { return a; }
    /// Splits an operand at a jump of the operation; nullopt if there is none. Points have none.
    static std::optional<std::pair<Value, Value>> split(Op, const Operands<Value>&) { return std::nullopt; }
    static bool may_be_split(const Value&) { return false; }

private:
    static Value bits_as(Scalar result, Scalar of, const Value& a) {
        if (of == Scalar::real && result != Scalar::real)
            return whole(std::bit_cast<uint32_t>(float(a.real)));
        return of != Scalar::real && result == Scalar::real ? constant(a.bits, result) : a;
    }
};

} // namespace tidemark::proof
