// GLSL's operations on whole numbers and their bits. Results that the language leaves undefined are those of
// drivers on a CPU: shifts use the lowest five bits, a division by zero gives all bits set.
#pragma once

#include "ir/function.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace tidemark::ir {

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

} // namespace tidemark::ir
