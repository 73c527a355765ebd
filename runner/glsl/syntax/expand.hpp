// A text without macros: the code that the preprocessor leaves, every word with the two places that matter to
// its author, where it is written and where the macro that holds it is used.
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

/// A token of GLSL proper: operators of several characters are one word.
struct Word {
    std::string_view text;
    uint32_t spelled = 0; ///< the token it was cut from; in a macro's body for what a macro stands for
    uint32_t used = 0;    ///< the outermost macro's name in the code; the same token where there is no macro
    text::TokenKind kind = text::TokenKind::punctuation;

    bool is(std::string_view wanted) const { return text == wanted; }
    bool from_macro() const { return spelled != used; }
};

/// The views stay valid as long as the text and this value do.
struct Expansion {
    std::vector<Word> words;
    std::vector<size_t> headers;    ///< the `#` of each #version and #extension, as indices of tokens
    std::deque<std::string> pasted; ///< words that `##` and __LINE__ made
};

/// Fails (ErrorCode::load), naming the line, where a condition cannot be evaluated without the driver, where
/// a macro is called without end, and when macros make more than 64 words from each of the text's (4 million
/// at most).
Result<Expansion> expand(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed,
                         const text::LineMap& lines);

} // namespace tidemark::glsl
