// Places within a line as most editors count them: in UTF-16 units. Bytes that are no UTF-8 count one each.
#pragma once

#include <cstddef>
#include <string_view>

namespace tidemark::text {

size_t utf16_length(std::string_view utf8);

/// How many bytes the first `units` take; all of them where there are not so many. A character is not cut.
size_t bytes_of_utf16(std::string_view utf8, size_t units);

} // namespace tidemark::text
