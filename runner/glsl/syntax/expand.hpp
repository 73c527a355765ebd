// Expands macros: returns the code that the preprocessor leaves. Every word keeps two source tokens: the one
// that spells it, and the outermost macro use that produced it.
#pragma once

#include "base/result.hpp"
#include "glsl/syntax/preprocess.hpp"
#include "text/mapped_text.hpp"
#include "text/tokens.hpp"

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// A token of the expanded code. An operator of several characters is one word.
struct Word {
    std::string_view text;
    /// index of the source token that it was cut from; inside a macro's body if a macro produced it
    uint32_t spelled = 0;
    /// index of the outermost macro's name in the code; the same token if no macro is involved
    uint32_t used = 0;
    text::TokenKind kind = text::TokenKind::punctuation;

    bool is(std::string_view wanted) const { return text == wanted; }
    bool from_macro() const { return spelled != used; }
};

/// The views stay valid as long as both the source text and this value exist.
struct Expansion {
    std::vector<Word> words;
    std::vector<size_t> headers;    ///< the `#` of each #version and #extension, as token indices
    std::deque<std::string> pasted; ///< texts made by `##` and __LINE__
};

/// Expands all macros. Fails (ErrorCode::load), with the line, if a condition cannot be evaluated without the
/// driver, if a macro call has no end, and if the result exceeds 64 words for each source token (plus 10,000;
/// at most 4 million).
Result<Expansion> expand(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed,
                         const text::LineMap& lines);

} // namespace tidemark::glsl
