// Writes the zero of a type as GLSL: `0.0`, `vec3(0.0)`, `Hit(0.0, vec2[2](vec2(0.0), vec2(0.0)))`.
#pragma once

#include "glsl/flow/shape.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <optional>
#include <string>

namespace tidemark::glsl {

/// Returns the name of the shape's constructor: `float[2][3]`.
std::string constructor_of(const Shape& shape);

/// Returns nothing for a type without constructor, with more than 64 numbers, or with structures whose names
/// have another meaning somewhere in the text.
std::optional<std::string> zero_value(const Shape& shape, const TreeFacts& facts);

} // namespace tidemark::glsl
