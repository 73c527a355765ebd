// Finds the number that ends a loop, if its head has one: `i < 64`, `i++ < 1e2`, `i < 64 && t < 20.0`.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <optional>

namespace tidemark::glsl {

struct LoopBound {
    NodeId number = k_no_node; ///< literal upper limit of a counter with step 1; k_no_node if there is none
    double first = 0;          ///< start value
    double turns = 0;          ///< iterations; valid if there is a number
};

/// Returns nothing for a loop that its head does not certainly end (provided that the body does not change
/// the counter). A counter without a value in the head starts at 0.
std::optional<LoopBound> loop_bound(const ParsedText& text, NodeId loop);

/// Returns the condition of any loop; k_no_node if it has none.
NodeId loop_condition(const ParsedText& text, NodeId loop);

} // namespace tidemark::glsl
