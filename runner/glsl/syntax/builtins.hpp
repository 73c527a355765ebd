// What GLSL itself declares: its types of floating-point numbers and its functions. For passes that must know
// whether a name is the author's own.
#pragma once

#include <string>
#include <string_view>

namespace tidemark::glsl {

/// `float`, `vec2` … `mat4x4`.
bool is_float_type(std::string_view word);

/// The same type of doubles (`dvec2`); only for a float type.
std::string double_type_of(std::string_view float_type);

/// `dvec2` -> `vec2`; empty for any other word.
std::string_view float_type_of(std::string_view double_type);

/// Scalars and vectors of int, uint and bool.
bool is_whole_type(std::string_view word);

/// A function of GLSL 4.50 that a fragment shader may call, of its older names none.
bool is_builtin_function(std::string_view name);

/// The arguments that this function writes through, a bit each, the first one's the lowest.
unsigned builtin_written_arguments(std::string_view name);

/// A word of the language that is neither a type nor a function.
bool is_keyword(std::string_view word);

} // namespace tidemark::glsl
