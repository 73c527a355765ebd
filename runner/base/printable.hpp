// Makes texts of scenes, files and drivers safe to show in a terminal, a title or a shell: characters that
// would control it become visible escapes.
#pragma once

#include <string>
#include <string_view>

namespace tidemark {

/// Escapes control characters except tab and line feed, bytes that are not UTF-8, and invisible characters
/// that change the layout or the writing direction: `\x1b`, `\u202e`.
std::string printable(std::string_view text);

/// Like printable, but for one line: escapes tab and line feed too.
std::string printable_line(std::string_view text);

/// Returns whether `printable_line` would change nothing.
bool is_printable_line(std::string_view text);

/// Replaces every byte that is not UTF-8 with U+FFFD.
std::string valid_utf8(std::string_view text);

/// Returns the text; if it is longer than `most` bytes, its first whole characters and `...`.
std::string cut_text(std::string_view text, size_t most);

/// The first character of `text`, which must not be empty: its length in bytes and its code point, or 1 and
/// -1 if it is not valid UTF-8.
struct Character {
    size_t length = 1;
    int code = -1;
};
Character first_character(std::string_view text);

} // namespace tidemark
