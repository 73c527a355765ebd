// The type of an expression, as far as declarations, built-in functions and the author's own say it.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"
#include "glsl/syntax/types.hpp"

#include <optional>

namespace tidemark::glsl {

/// Numbers, vectors and matrices. Nothing for other types, and where a name is declared twice in its
/// function, or twice outside of all.
std::optional<ValueType> expression_type(const ParsedText& text, const TreeFacts& facts, NodeId expression);

} // namespace tidemark::glsl
