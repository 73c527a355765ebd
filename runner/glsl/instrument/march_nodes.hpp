// Where a marching loop, found in the SSA form of a text by its lines, stands in the text's syntax tree. What
// is not certain is refused.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string>
#include <vector>

namespace tidemark::glsl {

/// A marching loop as it is known without the tree.
struct MarchLines {
    SourceLocation test;               ///< the line of the comparison that looks at the distance
    size_t comparisons = 1, which = 0; ///< of reals in that line of the loop, and which of them it is
    bool distance_is_less = true;      ///< the distance is on the side of the comparison that is to be less
    std::vector<SourceLocation> updates{}; ///< where the place on the ray goes on
    bool at_update = false;                ///< the distance is that of the place after the step
    bool fixed_steps = false;              ///< it goes on by a constant
    bool in_next_turn = false;             ///< the test looks at the distance of the turn before
    bool stops_before = true;              ///< a distance below 0 lies past the surface

    bool operator==(const MarchLines& other) const;
};

/// A comparison that ends the loop after so many turns, where it is `stopping`.
struct TurnLimit {
    NodeId test = k_no_node;
    bool stopping = false;
};

struct MarchNodes {
    NodeId loop = k_no_node;
    NodeId test = k_no_node;
    NodeId distance = k_no_node, threshold = k_no_node; ///< sides of the test
    bool in_head = false;      ///< the test stands in the loop's head, which is evaluated before its body
    std::string place;         ///< what the loop moves along the ray, in the text's words
    bool place_before = false; ///< it is there before the loop
    std::vector<TurnLimit> limits;
};

/// The error says what is not certain, with its place.
Result<MarchNodes> find_march(const ParsedText& text, const TreeFacts& facts, const MarchLines& lines);

/// What repeats in a loop, and what decides whether it does; k_no_node where there is none.
NodeId body_of(const SyntaxTree& tree, NodeId loop);
NodeId head_of(const SyntaxTree& tree, NodeId loop);

} // namespace tidemark::glsl
