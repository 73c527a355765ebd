// Functions of the author's that have the name of a built-in one. WebGL's compilers have let them stand
// beside it; on a desktop they hide it, whatever its parameters are. Text and edits that put both under
// another name.
#pragma once

#include "glsl/syntax/preprocess.hpp"
#include "text/mapped_text.hpp"
#include "text/tokens.hpp"

#include <string>
#include <vector>

namespace tidemark::glsl {

/// Whether the text defines a function that `join_overloads` has something to do for.
bool overloads_builtins(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed);

struct JoinedOverloads {
    /// The built-in's own signatures under the new name, without those that the author replaces. A call of
    /// one is no constant expression.
    std::string functions;
    std::vector<text::Edit> edits; ///< of the author's definitions and calls, in the order of the text
};

JoinedOverloads join_overloads(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed);

} // namespace tidemark::glsl
