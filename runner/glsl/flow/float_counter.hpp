// Finds loops whose float counter has rounding errors: `for (float x = 0.0; x < 1.0; x += 0.01)` has 101
// iterations, since 100 rounded steps add up to less than 1.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

struct FloatCounter {
    NodeId loop = k_no_node;
    std::string_view name;
    NodeId first = k_no_node, step = k_no_node; ///< start value and step
    bool down = false;                          ///< `-=`
    /// iterations in floats; infinite if a step is lost in rounding
    double turns = 0;
    double exact_turns = 0;                     ///< iterations in real arithmetic
};

/// Returns the loops that have another number of iterations in floats than in real arithmetic, in text order.
/// Covers only loops with literal numbers whose head declares, tests and steps the counter, and whose body
/// does not change it.
std::vector<FloatCounter> miscounting_loops(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
