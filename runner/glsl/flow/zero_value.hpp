// The zero of a type, as its author would write it: `0.0`, `vec3(0.0)`, `Hit(0.0, vec2[2](vec2(0.0),
// vec2(0.0)))`.
#pragma once

#include "glsl/flow/shape.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <optional>
#include <string>

namespace tidemark::glsl {

/// `float[2][3]`: what a constructor of that shape is called.
std::string constructor_of(const Shape& shape);

/// Nothing for what has no constructor, what has more than 64 numbers, and what has structures whose names
/// mean something else somewhere in the text.
std::optional<std::string> zero_value(const Shape& shape, const TreeFacts& facts);

} // namespace tidemark::glsl
