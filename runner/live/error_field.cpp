#include "live/error_field.hpp"

#include <algorithm>
#include <cstddef>

namespace tidemark::live {
namespace {

bool begins_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
}

/// Returns the byte offset of the character with that index (from 0) in UTF-8.
size_t byte_of(std::string_view text, size_t character) {
    size_t i = 0;
    for (; i < text.size(); ++i)
        if (begins_character(text[i]) && character-- == 0)
            break;
    return i;
}

} // namespace

Excerpt excerpt_of(std::string_view line, int column, size_t most) {
    std::string text(line);
    std::ranges::replace(text, '\t', ' ');
    const size_t before = std::min(text.size(), size_t(std::max(column - 1, 0)));
    const auto place =
        size_t(std::count_if(text.begin(), text.begin() + std::ptrdiff_t(before), begins_character));
    const size_t first = place < most ? 0 : place - most / 2;
    const size_t begin = byte_of(text, first);
    text = text.substr(begin, byte_of(std::string_view(text).substr(begin), most));
    return {std::move(text), column > 0 ? std::string(place - first, ' ') + "^" : ""};
}

} // namespace tidemark::live
