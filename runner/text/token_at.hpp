// The token at a place of a text, as editors point at one: line and column, counted from 1.
#pragma once

#include <string_view>

namespace tidemark::text {

/// That line without its end; empty where there is none.
std::string_view line_of(std::string_view text, int line);

/// One past the last column, in bytes, of the token that begins at `column` of a line; 0 where none does.
int end_of_token(std::string_view line, int column);

} // namespace tidemark::text
