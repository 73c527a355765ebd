// The one value of a variable that is declared with it and never changed.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

namespace tidemark::glsl {

/// The expression that `name` is declared with, where its function, or the text outside of functions,
/// declares it once and nothing sets it afterwards; k_no_node else, and of what is no name. What the
/// expression itself is made of may have changed since then.
NodeId single_value(const ParsedText& text, const TreeFacts& facts, NodeId name);

} // namespace tidemark::glsl
