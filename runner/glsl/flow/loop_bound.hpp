// The number that ends a loop, where its text says one: `i < 64`, `i++ < 1e2`, `i < 64 && t < 20.0`.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <optional>

namespace tidemark::glsl {

struct LoopBound {
    NodeId number = k_no_node; ///< the literal that is counted to, by ones; k_no_node: there is none
    double first = 0;          ///< what it counts from
    double turns = 0;          ///< where there is a number
};

/// Nothing for a loop that nothing in its head ends for certain, as far as its body leaves the counter alone.
/// A counter that has no value in the head counts from 0.
std::optional<LoopBound> loop_bound(const ParsedText& text, NodeId loop);

/// Of a loop of any kind; k_no_node: it has none.
NodeId loop_condition(const ParsedText& text, NodeId loop);

} // namespace tidemark::glsl
