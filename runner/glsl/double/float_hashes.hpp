// Finds the hashes in a text: functions and expressions that take the last bits of a float for random
// numbers, `fract(sin(x) * 43758.5)` and their like. In double they would give other numbers, that is,
// another scene: the same scene in more digits needs them as they are.
#pragma once

#include "glsl/syntax/reading.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

enum class HashKind : unsigned char {
    sine,    ///< fract of a large multiple of a sine
    product, ///< fract of products of fracts
    bits     ///< floatBitsToUint and floatBitsToInt: the bits of a float, whatever the precision
};

std::string_view to_string(HashKind kind);

/// Tokens [begin, end) that are to be evaluated in floats.
struct FloatRegion {
    size_t begin = 0;
    size_t end = 0;
    const Function* whole = nullptr; ///< a function from return type to brace; nullptr: an expression
    HashKind kind = HashKind::sine;
    /// First and last tokens of what comes from outside: to be evaluated in double and then made a float.
    std::vector<std::pair<size_t, size_t>> outside{};
};

/// In the order of the text, without overlap.
std::vector<FloatRegion> find_float_regions(const Reading& reading);

} // namespace tidemark::glsl
