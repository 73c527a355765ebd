// Splits GLSL text into tokens with their places; comments and blanks are skipped. All readers and rewriters
// of shader text share this lexer. It never fails, whatever the bytes are.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace tidemark::text {

enum class TokenKind : unsigned char {
    identifier,
    number,      ///< a preprocessing number: 1, .5, 1e-3, 0x1Fu, 1.f
    string,      ///< with its quotes; only directives have strings
    punctuation, ///< one character
};

struct Token {
    std::string_view text; ///< view into the tokenized text
    size_t begin = 0;      ///< offset of the first character
    int line = 0;          ///< counted from 1
    int column = 0;        ///< counted from 1, in bytes
    TokenKind kind = TokenKind::punctuation;
    bool first_on_line = false; ///< for the preprocessor: joined lines and line ends in comments do not count
    bool glued = false;         ///< nothing separates it from the previous token

    size_t end() const { return begin + text.size(); }
    bool is(std::string_view wanted) const { return text == wanted; }
};

/// Returns whether `c` may be part of a name or a number.
bool is_word_character(char c);

/// Returns all tokens of `text`, in order; linear in its size. The views stay valid as long as `text` does.
std::vector<Token> tokenize(std::string_view text);

/// Returns one past the last token of the directive whose first token is `first`.
size_t end_of_directive(const std::vector<Token>& tokens, size_t first);

// Token at a place of a text. Places are lines and columns counted from 1, as in editors.

/// Returns the line without its line end; empty if there is no such line.
std::string_view line_of(std::string_view text, int line);

/// Returns one past the last column, in bytes, of the token that begins at `column` of a line; 0 if none
/// does.
int end_of_token(std::string_view line, int column);

// Splits a text into lines.

/// Returns the lines without their line ends, as views into the text. A last line without a line end counts
/// if it is not empty.
std::vector<std::string_view> lines_of(std::string_view text);

// Places within a line in UTF-16 units, as most editors count them. A byte that is not valid UTF-8 counts as
// one unit.

size_t utf16_length(std::string_view utf8);

/// Returns the number of bytes in the first `units` units; all bytes if there are fewer units. Never splits a
/// character.
size_t bytes_of_utf16(std::string_view utf8, size_t units);

} // namespace tidemark::text
