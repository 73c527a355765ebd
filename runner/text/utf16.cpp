#include "text/utf16.hpp"

#include <algorithm>

namespace tidemark::text {
namespace {

bool continues(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// Returns the number of bytes of the first character of `rest`, which is not empty.
size_t bytes_of_first(std::string_view rest) {
    const auto first = static_cast<unsigned char>(rest.front());
    const size_t wanted = first >= 0xF0 && first < 0xF8 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
    const std::string_view others = rest.substr(1, wanted - 1);
    const bool whole = others.size() == wanted - 1 && std::ranges::all_of(others, continues);
    return whole && first < 0xF8 ? wanted : 1;
}

/// Four bytes of UTF-8 encode characters beyond U+FFFF, which need two UTF-16 units.
size_t units_of(size_t bytes) {
    return bytes == 4 ? 2 : 1;
}

} // namespace

size_t utf16_length(std::string_view utf8) {
    size_t units = 0;
    for (size_t at = 0; at < utf8.size();) {
        const size_t bytes = bytes_of_first(utf8.substr(at));
        units += units_of(bytes);
        at += bytes;
    }
    return units;
}

size_t bytes_of_utf16(std::string_view utf8, size_t units) {
    size_t at = 0;
    while (at < utf8.size()) {
        const size_t bytes = bytes_of_first(utf8.substr(at));
        if (units < units_of(bytes))
            break;
        units -= units_of(bytes);
        at += bytes;
    }
    return at;
}

} // namespace tidemark::text
