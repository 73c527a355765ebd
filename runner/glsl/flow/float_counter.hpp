// Loops that count by steps no float holds: `for (float x = 0.0; x < 1.0; x += 0.1)` turns eleven times,
// since ten steps, each rounded, add up to less than 1.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

struct FloatCounter {
    NodeId loop = k_no_node;
    std::string_view name;
    NodeId first = k_no_node, step = k_no_node; ///< the numbers that it begins with and goes on by
    bool down = false;                          ///< `-=`
    double turns = 0;                           ///< in floats; infinite: a step is lost in rounding
    double exact_turns = 0;                     ///< in real arithmetic
};

/// Those whose turns in floats are others than in real arithmetic, by their numbers alone; in the order of
/// the text. Only loops whose head declares, tests and steps the counter, and whose body leaves it alone.
std::vector<FloatCounter> miscounting_loops(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
