// A text prepared for token-based passes: tokens, preprocessor activity, functions. Used by every pass that
// rewrites code and not only names.
#pragma once

#include "glsl/syntax/functions.hpp"
#include "glsl/syntax/preprocess.hpp"
#include "text/tokens.hpp"

#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

/// Kind of line that contains a token.
enum class Place : unsigned char {
    code,
    macro_head, ///< #define or #undef, up to the parameters
    macro_body,
    directive ///< any other directive
};

/// The views stay valid as long as the text does.
struct Reading {
    explicit Reading(std::string_view text);
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

    std::vector<text::Token> tokens;
    Preprocessed preprocessed;
    std::vector<Function> functions;
    std::vector<Place> places; ///< one entry for each token; inactive tokens count as code
    /// Every macro name with its first definition.
    std::unordered_map<std::string_view, const MacroLine*> macros;

    std::unordered_map<std::string_view, std::vector<const Function*>> overloads; ///< by name

    bool active(size_t token) const { return preprocessed.activity[token] != Activity::inactive; }
    /// Returns whether the text has a function or macro of that name.
    bool defines(std::string_view name) const;
    /// Returns the token that closes the parenthesis, bracket or brace at `open`; `end` if none before `end`
    /// does.
    size_t closing(size_t open, size_t end) const;
    /// Returns whether the tokens at `i` are the two-character operator `two`.
    bool is_pair(size_t i, std::string_view two) const;

private:
    std::vector<size_t> closing_;
};

} // namespace tidemark::glsl
