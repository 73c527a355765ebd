// A shader that shows what one of its expressions had for a value, in place of the picture: the last one in
// each pixel, NaN where it was not come to. A uniform says which. Text in, text out.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <span>
#include <string>
#include <string_view>

namespace tidemark::glsl {

struct SeenValues {
    std::string text; ///< empty: the text has a `main` of its author's, whose output is not ours to know
    std::string which_uniform; ///< int, an index of the expressions
};

/// `expressions` are of floats and vectors of floats; `output` is what our `main` writes.
SeenValues see_values(const ParsedText& text, std::span<const NodeId> expressions, std::string_view output);

} // namespace tidemark::glsl
