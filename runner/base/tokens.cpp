#include "base/tokens.hpp"

#include "base/encoding.hpp"

#include <algorithm>

namespace tidemark::text {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\v' || c == '\f' || c == '\r';
}

class Lexer {
public:
    explicit Lexer(std::string_view text) : text_(text) {}

    std::vector<Token> run() {
        tokens_.reserve(text_.size() / 3);
        while (skip_to_token())
            tokens_.push_back(next());
        return std::move(tokens_);
    }

private:
    char at(size_t offset) const { return offset < text_.size() ? text_[offset] : '\0'; }

    /// A backslash before a line end joins the lines; compilers treat both characters as blanks.
    bool at_line_joint() const { return at(position_) == '\\' && at(position_ + 1) == '\n'; }

    /// Counts the line feed at `position_`. One inside a comment or after a backslash begins no line for the
    /// preprocessor.
    void advance_line(bool begins_line) {
        ++line_;
        line_begin_ = position_ + 1;
        first_on_line_ = first_on_line_ || begins_line;
    }

    bool skip_to_token() {
        skipped_ = position_ == 0;
        while (position_ < text_.size()) {
            if (at_line_joint()) {
                ++position_;
                advance_line(false);
                ++position_;
            } else if (is_blank(at(position_))) {
                if (at(position_) == '\n')
                    advance_line(true);
                ++position_;
            } else if (at(position_) == '/' && at(position_ + 1) == '/') {
                skip_line_comment();
            } else if (at(position_) == '/' && at(position_ + 1) == '*') {
                skip_block_comment();
            } else {
                return true;
            }
            skipped_ = true;
        }
        return false;
    }

    void skip_line_comment() {
        while (position_ < text_.size() && at(position_) != '\n') {
            if (at_line_joint()) { // the comment continues
                ++position_;
                advance_line(false);
            }
            ++position_;
        }
    }

    void skip_block_comment() {
        const size_t close = text_.find("*/", position_ + 2);
        const size_t end = close == std::string_view::npos ? text_.size() : close + 2;
        for (; position_ < end; ++position_)
            if (at(position_) == '\n')
                advance_line(false);
    }

    Token next() {
        Token token;
        token.begin = position_;
        token.line = line_;
        token.column = int(position_ - line_begin_) + 1;
        token.first_on_line = first_on_line_;
        token.glued = !skipped_;
        token.kind = kind_here();
        position_ = end_of(token.kind);
        token.text = text_.substr(token.begin, position_ - token.begin);
        first_on_line_ = false;
        return token;
    }

    TokenKind kind_here() {
        const char c = at(position_);
        if (is_digit(c) || (c == '.' && is_digit(at(position_ + 1))))
            return TokenKind::number;
        if (is_word_character(c))
            return TokenKind::identifier;
        if ((c == '"' || c == '\'') && closes_on_line())
            return TokenKind::string;
        return TokenKind::punctuation;
    }

    /// Checks that the string here ends on its line, and if so stores its end in `closing_quote_`. For a
    /// quote without an end it stores how far it searched: later quotes of the same kind on that line have no
    /// end either, which keeps the lexer linear.
    bool closes_on_line() {
        const char quote = at(position_);
        size_t& open_until = quote == '"' ? double_open_until_ : single_open_until_;
        if (position_ < open_until)
            return false;
        size_t i = position_ + 1;
        while (i < text_.size() && text_[i] != '\n') {
            if (text_[i] == quote) {
                closing_quote_ = i;
                return true;
            }
            i += text_[i] == '\\' && i + 1 < text_.size() && text_[i + 1] != '\n' ? 2 : 1;
        }
        open_until = i;
        return false;
    }

    size_t end_of(TokenKind kind) const {
        size_t i = position_ + 1;
        switch (kind) {
        case TokenKind::identifier:
            while (is_word_character(at(i)))
                ++i;
            return i;
        case TokenKind::number: return end_of_number();
        case TokenKind::string: return closing_quote_ + 1;
        case TokenKind::punctuation: return i;
        }
        return i;
    }

    /// `1..xxx` is `1.` and `.xxx`, `1.xx` is `1.` and `xx`; `0x1.` is `0x1` and `.`.
    size_t end_of_number() const {
        size_t i = position_;
        if (at(i) == '0' && (at(i + 1) == 'x' || at(i + 1) == 'X')) {
            i += 2;
            while (is_word_character(at(i)))
                ++i;
            return i;
        }
        while (is_digit(at(i)))
            ++i;
        if (at(i) == '.')
            ++i;
        while (is_digit(at(i)))
            ++i;
        if (at(i) == 'e' || at(i) == 'E') {
            const size_t digits = i + (at(i + 1) == '+' || at(i + 1) == '-' ? 2 : 1);
            if (is_digit(at(digits))) {
                i = digits;
                while (is_digit(at(i)))
                    ++i;
            }
        }
        while (at(i) == 'u' || at(i) == 'U' || at(i) == 'f' || at(i) == 'F' || at(i) == 'l' || at(i) == 'L')
            ++i;
        return i;
    }

    std::string_view text_;
    std::vector<Token> tokens_;
    size_t position_ = 0;
    size_t line_begin_ = 0;
    size_t closing_quote_ = 0;     ///< end of the string at `position_`
    size_t double_open_until_ = 0; ///< no string in double quotes ends before this offset
    size_t single_open_until_ = 0;
    int line_ = 1;
    bool first_on_line_ = true;
    bool skipped_ = false; ///< blanks or comments precede, or this is the beginning of the text
};

} // namespace

bool is_word_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
}

std::vector<Token> tokenize(std::string_view text) {
    return Lexer(text).run();
}

size_t end_of_directive(const std::vector<Token>& tokens, size_t first) {
    size_t i = first + 1;
    while (i < tokens.size() && !tokens[i].first_on_line)
        ++i;
    return i;
}

std::string_view line_of(std::string_view text, int line) {
    for (int at = 1; at < line; ++at) {
        const size_t end = text.find('\n');
        if (end == text.npos)
            return {};
        text.remove_prefix(end + 1);
    }
    return text.substr(0, text.find('\n'));
}

int end_of_token(std::string_view line, int column) {
    if (column < 1 || size_t(column) > line.size())
        return 0;
    const auto tokens = tokenize(line.substr(size_t(column) - 1));
    return tokens.empty() || tokens.front().begin != 0 ? 0 : column + int(tokens.front().text.size());
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

namespace {

/// Returns the number of bytes of the first character of `rest`, which is not empty.
size_t bytes_of_first(std::string_view rest) {
    const auto first = static_cast<unsigned char>(rest.front());
    const size_t wanted = first >= 0xF0 && first < 0xF8 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
    const std::string_view others = rest.substr(1, wanted - 1);
    const bool whole = others.size() == wanted - 1 && std::ranges::all_of(others, continues_character);
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
