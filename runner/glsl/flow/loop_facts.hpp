// Facts from the head of a `for` loop: whether its body certainly runs, and whether it covers a whole array.
#pragma once

#include "glsl/flow/shape.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <vector>

namespace tidemark::glsl {

/// Returns whether a condition is absent or `true`.
bool is_always_true(const ParsedText& text, NodeId condition);

/// Returns whether a `for` certainly runs its body at least once: `int i = 0; i < 8`.
bool enters_surely(const ParsedText& text, const Shapes& shapes, NodeId loop);

/// Returns the arrays `a` for which `for (int i = 0; i < N; ++i)` sets `a[i]` in each iteration, by `=` or as
/// an argument that a function with one definition writes. The nodes are those of `a`. Empty if the loop may
/// skip or leave an iteration. Check with fills() that N covers the array.
std::vector<NodeId> filled_arrays(const ParsedText& text, const TreeFacts& facts, NodeId loop);

/// Returns whether such an array, of that shape and declaration, has no more elements than the loop has
/// iterations.
bool fills(const ParsedText& text, const Shapes& shapes, NodeId loop, NodeId declared, const Shape& shape,
           NodeId array);

} // namespace tidemark::glsl
