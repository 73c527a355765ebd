// Places within a line in UTF-16 units, as most editors count them. A byte that is not valid UTF-8 counts as
// one unit.
#pragma once

#include <cstddef>
#include <string_view>

namespace tidemark::text {

size_t utf16_length(std::string_view utf8);

/// Returns the number of bytes in the first `units` units; all bytes if there are fewer units. Never splits a
/// character.
size_t bytes_of_utf16(std::string_view utf8, size_t units);

} // namespace tidemark::text
