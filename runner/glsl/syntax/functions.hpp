// Finds the functions that a text defines or declares: return type, parameters with qualifiers, body. Reads
// tokens and never fails; does not see functions that macros define.
#pragma once

#include "glsl/syntax/preprocess.hpp"
#include "text/tokens.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

struct Parameter {
    std::string_view type;
    std::string_view name; ///< empty if it has none
    bool written = false;  ///< `out`, `inout`
    bool read = true;      ///< not `out`
    bool array = false;
};

/// Numbers are token indices. Only tokens in `Preprocessed::code` are considered.
struct Function {
    std::string_view return_type;
    std::string_view name;
    std::vector<Parameter> parameters;
    size_t type_token = 0; ///< the return type
    size_t name_token = 0;
    size_t open = 0;       ///< (
    size_t close = 0;      ///< )
    size_t body_begin = 0; ///< {; 0 if the function is only declared
    size_t body_end = 0;   ///< its }

    bool defined() const { return body_begin != 0; }
    bool writes_argument() const;
};

/// Returns the functions in text order.
std::vector<Function> find_functions(const std::vector<text::Token>& tokens,
                                     const Preprocessed& preprocessed);

/// Returns the function whose definition contains `token`; nullptr if none does.
const Function* function_around(const std::vector<Function>& functions, size_t token);

} // namespace tidemark::glsl
