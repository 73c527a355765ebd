// Type of an expression, as far as declarations, built-in functions and the author's functions determine it.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"
#include "glsl/syntax/types.hpp"

#include <optional>

namespace tidemark::glsl {

/// Returns scalar, vector and matrix types. Returns nothing for other types, and for a name that is declared
/// twice in its function or twice globally.
std::optional<ValueType> expression_type(const ParsedText& text, const TreeFacts& facts, NodeId expression);

} // namespace tidemark::glsl
