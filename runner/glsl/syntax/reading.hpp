// A text as the passes over it see it: tokens, what the preprocessor keeps of them, functions. Shared by
// every pass that rewrites code and not only names.
#pragma once

#include "glsl/syntax/functions.hpp"
#include "glsl/syntax/preprocess.hpp"
#include "text/tokens.hpp"

#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

/// On which kind of line a token stands.
enum class Place : unsigned char {
    code,
    macro_head, ///< of a #define or #undef: up to the parameters
    macro_body,
    directive ///< any other
};

/// The views stay valid as long as the text does.
struct Reading {
    explicit Reading(std::string_view text);
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

    std::vector<text::Token> tokens;
    Preprocessed preprocessed;
    std::vector<Function> functions;
    std::vector<Place> places; ///< of each token; what is inactive counts as code
    /// Each name that is a macro somewhere, with its first definition.
    std::unordered_map<std::string_view, const MacroLine*> macros;

    std::unordered_map<std::string_view, std::vector<const Function*>> overloads; ///< by name

    bool active(size_t token) const { return preprocessed.activity[token] != Activity::inactive; }
    /// A function or a macro of the author's.
    bool defines(std::string_view name) const;
    /// The token that closes the parenthesis, bracket or brace at `open`, before `end`; `end` if none does.
    size_t closing(size_t open, size_t end) const;
    /// Whether the tokens at `i` are the operator `two`, of two characters.
    bool is_pair(size_t i, std::string_view two) const;

private:
    std::vector<size_t> closing_;
};

} // namespace tidemark::glsl
