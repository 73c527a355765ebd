// Numbers as GLSL writes them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::glsl {

/// `12`, `0x1F`, `017`, without sign and suffix; nothing for other texts and beyond `long`.
std::optional<long> whole_number(std::string_view digits);

/// `12u`, `1.5f`, `1e2`; nothing for other texts and for hexadecimal ones.
std::optional<double> number(std::string_view word);

/// `2.0` of `2`, and what is read as a float anyway as it is: of digits as C++ writes a number.
std::string as_float(std::string_view digits);

} // namespace tidemark::glsl
