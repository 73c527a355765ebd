// Instruments a shader so that it shows the value of one of its expressions instead of the picture: the last
// value in each pixel, or NaN where the expression was not evaluated. A uniform selects it. Text in, text
// out.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <span>
#include <string>
#include <string_view>

namespace tidemark::glsl {

struct SeenValues {
    std::string text; ///< empty: the text has its author's own `main`, whose output is unknown
    std::string which_uniform; ///< int, an index into the expressions
};

/// `expressions` are floats and vectors of floats; `output` is the variable that our `main` writes.
SeenValues see_values(const ParsedText& text, std::span<const NodeId> expressions, std::string_view output);

} // namespace tidemark::glsl
