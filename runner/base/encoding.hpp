// Texts, numbers and bytes in each other: blanks, numbers in text, printable text, shell words, URIs, base64,
// SHA-256.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark {

inline std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r\n") {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1); // npos + 1 is 0
}

/// Returns the text with A to Z as small letters.
inline std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z')
            c = char(c - 'A' + 'a');
    return text;
}

/// Returns the last line that is not empty, without its end.
inline std::string last_line(std::string text) {
    text.erase(text.find_last_not_of("\r\n") + 1);
    return text.substr(text.rfind('\n') + 1);
}

/// Removes a number, as std::from_chars reads it (no blanks, no plus), from the front of `text`; returns
/// false if there is none.
template <class T>
bool consume_number(std::string_view& text, T& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{})
        return false;
    text.remove_prefix(size_t(end - text.data()));
    return true;
}

/// Removes a character from the front of `text`; returns false if the text begins otherwise.
inline bool consume(std::string_view& text, char wanted) {
    if (!text.starts_with(wanted))
        return false;
    text.remove_prefix(1);
    return true;
}

/// Returns the number of type T that the whole text spells.
template <class T>
std::optional<T> number_from(std::string_view text) {
    T number{};
    return consume_number(text, number) && text.empty() ? std::optional(number) : std::nullopt;
}

/// Returns the numbers that the whole text spells, with `separator` between them; none for any other text.
template <class T>
std::vector<T> numbers_from(std::string_view text, char separator = ',') {
    std::vector<T> numbers;
    do {
        if (!consume_number(text, numbers.emplace_back()))
            return {};
    } while (consume(text, separator));
    return text.empty() ? numbers : std::vector<T>();
}

/// Makes a float literal of GLSL from a number as C++ prints it: `2` becomes `2.0`; digits with a point or an
/// exponent stay.
std::string float_literal(std::string_view digits);

// Reads integers of several bytes from a file's bytes. Does not check bounds.

inline uint32_t big_endian(std::string_view file, size_t at, size_t bytes) {
    uint32_t value = 0;
    for (size_t i = 0; i < bytes; ++i)
        value = value << 8 | uint8_t(file[at + i]);
    return value;
}

inline uint32_t little_endian(std::string_view file, size_t at, size_t bytes) {
    uint32_t value = 0;
    for (size_t i = bytes; i-- > 0;)
        value = value << 8 | uint8_t(file[at + i]);
    return value;
}

// Makes texts of scenes, files and drivers safe to show in a terminal, a title or a shell: characters that
// would control it become visible escapes.

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

/// Returns whether a byte of UTF-8 continues the character before it.
inline bool continues_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
}

/// Returns the first byte of the character that the byte `at` belongs to; `at` may be the text's length.
size_t begin_of_character(std::string_view text, size_t at);

/// The first character of `text`, which must not be empty: its length in bytes and its code point, or 1 and
/// -1 if it is not valid UTF-8.
struct Character {
    size_t length = 1;
    int code = -1;
};
Character first_character(std::string_view text);

// Quotes and splits the arguments of a command line.

/// Quotes an argument for a POSIX shell: unchanged if that is safe, else between apostrophes, with escapes
/// for characters that control a terminal.
std::string shell_word(std::string_view word);

/// Quotes several arguments, with blanks between them.
std::string shell_words(std::span<const std::string> words);

/// Splits at blanks, as in `EDITOR="code --wait"`; quotes have no meaning, and no shell is used.
std::vector<std::string> split_words(std::string_view words);

// Converts file paths to URIs and back (RFC 3986, RFC 8089).

/// Returns `file:///a/b%20c.glsl` for an absolute path, `b%20c.glsl` for a relative one.
std::string uri_reference(const std::filesystem::path& path);

/// Returns the path that a `file:` URI names on this machine; nullopt for another scheme, another machine, a
/// damaged escape or a NUL.
std::optional<std::filesystem::path> path_of_uri(std::string_view uri);

// Encodes bytes as base64 text (RFC 4648).

std::string base64(std::string_view bytes);

// Computes SHA-256 fingerprints.

/// SHA-256 of data that comes piece by piece.
class Sha256 {
public:
    Sha256();
    ~Sha256();

    void add(std::span<const std::byte> bytes);
    /// Returns 64 lower-case hexadecimal digits. To be called once, after the last piece.
    std::string digits();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Returns the SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);

} // namespace tidemark
