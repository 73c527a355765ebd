// The functions that a text defines or announces: return type, parameters with their qualifiers, body. Reads
// tokens, never fails; what macros define is not seen.
#pragma once

#include "glsl/syntax/preprocess.hpp"
#include "text/tokens.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

struct Parameter {
    std::string_view type;
    std::string_view name; ///< empty: has none
    bool written = false;  ///< `out`, `inout`
    bool read = true;      ///< not `out`
    bool array = false;
};

/// The numbers are indices of tokens; of `Preprocessed::code` only.
struct Function {
    std::string_view return_type;
    std::string_view name;
    std::vector<Parameter> parameters;
    size_t type_token = 0; ///< the return type
    size_t name_token = 0;
    size_t open = 0;       ///< (
    size_t close = 0;      ///< )
    size_t body_begin = 0; ///< {, or 0 where it is only announced
    size_t body_end = 0;   ///< its }

    bool defined() const { return body_begin != 0; }
    bool writes_argument() const;
};

/// In the order of the text.
std::vector<Function> find_functions(const std::vector<text::Token>& tokens,
                                     const Preprocessed& preprocessed);

/// The function whose definition holds `token`; nullptr outside of all.
const Function* function_around(const std::vector<Function>& functions, size_t token);

} // namespace tidemark::glsl
