// Whole numbers as GLSL writes them.
#pragma once

#include <optional>
#include <string_view>

namespace tidemark::glsl {

/// `12`, `0x1F`, `017`, without sign and suffix; nothing for other texts and beyond `long`.
std::optional<long> whole_number(std::string_view digits);

} // namespace tidemark::glsl
