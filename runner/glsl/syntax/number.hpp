// Numbers as GLSL writes them.
#pragma once

#include <optional>
#include <string_view>

namespace tidemark::glsl {

/// `12`, `0x1F`, `017`, without sign and suffix; nothing for other texts and beyond `long`.
std::optional<long> whole_number(std::string_view digits);

/// `12u`, `1.5f`, `1e2`; nothing for other texts and for hexadecimal ones.
std::optional<double> number(std::string_view word);

} // namespace tidemark::glsl
