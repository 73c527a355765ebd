// Token at a place of a text. Places are lines and columns counted from 1, as in editors.
#pragma once

#include <string_view>

namespace tidemark::text {

/// Returns the line without its line end; empty if there is no such line.
std::string_view line_of(std::string_view text, int line);

/// Returns one past the last column, in bytes, of the token that begins at `column` of a line; 0 if none
/// does.
int end_of_token(std::string_view line, int column);

} // namespace tidemark::text
