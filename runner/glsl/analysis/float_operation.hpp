// Finds the operations of a text that can make a NaN or an infinity from finite values.
#pragma once

#include "glsl/syntax/tree_facts.hpp"

namespace tidemark::glsl {

/// Returns whether the node is float arithmetic or a call with a result, so that its value can be passed
/// through an inserted function.
bool is_float_operation(const ParsedText& text, const TreeFacts& facts, NodeId id);

} // namespace tidemark::glsl
