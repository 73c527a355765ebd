// What the site's compiler (ANGLE) adds to a text, and a desktop driver does not. It gives a zero to whatever
// begins without a value: variables of every type, `out` parameters, what a function gives back that comes to
// its end without a `return`; and a name to parameters that have none. Text in, text out; no line moves.
#pragma once

#include "glsl/dialect.hpp"
#include "glsl/syntax/preprocess.hpp"
#include "text/mapped_text.hpp"
#include "text/tokens.hpp"

#include <vector>

namespace tidemark::glsl {

/// Of a text that is complete but for its #version. What has a value before anything reads it, on every way,
/// is left as it is. A text that the parser cannot follow gets initialise_plain.
void start_at_zero(text::MappedText& text, Version version);

/// The same by tokens alone: every variable and `out` parameter of a plain type, in what macros stand for,
/// too. Arrays and variables of the author's own types are left alone.
std::vector<text::Edit> initialise_plain(const std::vector<text::Token>& tokens,
                                         const Preprocessed& preprocessed);

} // namespace tidemark::glsl
