// Handles functions of the author that have the name of a built-in one. WebGL compilers have accepted them as
// overloads; on a desktop they hide the built-in. Produces edits that give both another name.
#pragma once

#include "glsl/syntax/preprocess.hpp"
#include "text/mapped_text.hpp"
#include "text/tokens.hpp"

#include <string>
#include <vector>

namespace tidemark::glsl {

/// Returns whether the text defines a function that `join_overloads` handles.
bool overloads_builtins(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed);

struct JoinedOverloads {
    /// The built-in's signatures under the new name, except those that the author replaces. A call of one is
    /// not a constant expression.
    std::string functions;
    std::vector<text::Edit> edits; ///< the author's definitions and calls, in text order
};

JoinedOverloads join_overloads(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed);

} // namespace tidemark::glsl
