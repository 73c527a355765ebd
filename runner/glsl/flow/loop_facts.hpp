// What can be told of a `for` from its head alone: whether its body is come to at all, and whether it goes
// through a whole array.
#pragma once

#include "glsl/flow/shape.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <vector>

namespace tidemark::glsl {

/// Of a condition: nothing, or `true`.
bool is_always_true(const ParsedText& text, NodeId condition);

/// Whether a `for` certainly runs its body once: `int i = 0; i < 8`.
bool enters_surely(const ParsedText& text, const Shapes& shapes, NodeId loop);

/// The arrays `a` of which `for (int i = 0; i < N; ++i)` sets `a[i]` in each turn, by `=` or as an argument
/// that a function of one definition writes, and which are no longer than N. The nodes are those of `a`.
/// Empty where the loop may skip or leave a turn.
std::vector<NodeId> filled_arrays(const ParsedText& text, const TreeFacts& facts, NodeId loop);

/// Whether one of those, of `shape` and declared so, has no more elements than the loop has turns.
bool fills(const ParsedText& text, const Shapes& shapes, NodeId loop, NodeId declared, const Shape& shape,
           NodeId array);

} // namespace tidemark::glsl
