// GLSL text cut into tokens. Comments and blanks are skipped; every token knows its place. This is the
// lexer that all readers and rewriters of shader text share; it never fails, whatever the bytes are.
#pragma once

#include <string_view>
#include <vector>

namespace tidemark::text {

enum class TokenKind : unsigned char {
    identifier,
    number,      ///< a preprocessing number: 1, .5, 1e-3, 0x1Fu, 1.f
    string,      ///< quotes included; only directives have strings
    punctuation, ///< one character
};

struct Token {
    std::string_view text; ///< a view into the text that was cut
    size_t begin = 0;      ///< offset of the first character
    int line = 0;          ///< counted from 1
    int column = 0;        ///< counted from 1, in bytes
    TokenKind kind = TokenKind::punctuation;
    bool first_on_line = false; ///< as the preprocessor counts: joined lines and comments are no line ends
    bool glued = false;         ///< nothing stands between this token and the one before

    size_t end() const { return begin + text.size(); }
    bool is(std::string_view wanted) const { return text == wanted; }
};

/// Whether it may stand in a name or a number.
bool is_word_character(char c);

/// All tokens of `text`, in order; linear in its size. The views stay valid as long as `text` does.
std::vector<Token> tokenize(std::string_view text);

/// One past the last token of the preprocessor line that the token `first` begins.
size_t end_of_directive(const std::vector<Token>& tokens, size_t first);

} // namespace tidemark::text
