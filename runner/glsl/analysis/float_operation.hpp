// The operations of a text that can make a NaN or an infinity of finite values.
#pragma once

#include "glsl/syntax/tree_facts.hpp"

namespace tidemark::glsl {

/// Arithmetic on floats, and calls with a result, whose value a function of ours can take and hand on.
bool is_float_operation(const ParsedText& text, const TreeFacts& facts, NodeId id);

} // namespace tidemark::glsl
