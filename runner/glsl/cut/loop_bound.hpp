// The number that ends a loop, where its text says one: `i < 64`, `i++ < 1e2`, `i < 64 && t < 20.0`.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <optional>

namespace tidemark::glsl {

struct LoopBound {
    NodeId number = k_no_node;     ///< the expression that is counted to; k_no_node: it counts down
    std::optional<double> turns{}; ///< where that is a literal, and each turn counts one
};

/// Nothing for a loop that nothing in its head ends for certain, as far as its body leaves the counter alone.
std::optional<LoopBound> loop_bound(const ParsedText& text, NodeId loop);

/// Of a loop of any kind; k_no_node: it has none.
NodeId loop_condition(const ParsedText& text, NodeId loop);

} // namespace tidemark::glsl
