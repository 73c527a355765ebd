// Texts of scenes, files and drivers as a terminal, a title or a shell may be given them: what would steer it
// instead of being shown is made visible.
#pragma once

#include <string>
#include <string_view>

namespace tidemark {

/// The text with every control character but tab and line feed, every byte that is no UTF-8, and what turns
/// the direction of writing as an escape: `\x1b`, `\u202e`.
std::string printable(std::string_view text);

/// As printable, in one line: tab and line feed are escapes too.
std::string printable_line(std::string_view text);

/// Whether `printable_line` would change nothing.
bool is_printable_line(std::string_view text);

/// The text with U+FFFD for every byte that is no UTF-8.
std::string valid_utf8(std::string_view text);

/// The text where it has no more than `most` bytes, else what of it ends with a whole character, and `...`.
std::string cut_text(std::string_view text, size_t most);

/// The length of the first character of `text` where it is UTF-8 and its code point, else 1 and -1. `text` is
/// not empty.
struct Character {
    size_t length = 1;
    int code = -1;
};
Character first_character(std::string_view text);

} // namespace tidemark
