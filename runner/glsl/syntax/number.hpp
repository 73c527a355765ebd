// Reads and writes GLSL numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::glsl {

/// Reads `12`, `0x1F`, `017`, without sign and suffix. Returns nothing for other texts and if the value
/// exceeds `long`.
std::optional<long> whole_number(std::string_view digits);

/// Reads `12u`, `1.5f`, `1e2`. Returns nothing for other texts, hexadecimal numbers included.
std::optional<double> number(std::string_view word);

/// Makes a float literal of a number as C++ prints it: `2` becomes `2.0`; digits with a point or an exponent
/// stay.
std::string as_float(std::string_view digits);

} // namespace tidemark::glsl
