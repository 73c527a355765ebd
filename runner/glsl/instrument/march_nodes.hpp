// Finds the nodes of a marching loop in a syntax tree, given the loop's lines as the text's SSA form has
// them. Returns an error rather than a guess.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string>
#include <vector>

namespace tidemark::glsl {

/// A marching loop as the SSA form describes it, by lines.
struct MarchLines {
    SourceLocation test;               ///< line of the comparison that tests the distance
    size_t comparisons = 1, which = 0; ///< float comparisons in that line of the loop, and the test's index
                                       ///< among them
    bool distance_is_less = true;      ///< the distance is on the side of the comparison that must be less
    std::vector<SourceLocation> updates{}; ///< lines that advance the position on the ray
    bool at_update = false;                ///< the distance is measured after the step
    bool fixed_steps = false;              ///< the position advances by a constant
    bool in_next_turn = false;             ///< the test reads the distance of the previous iteration
    bool stops_before = true;              ///< a negative distance means past the surface

    bool operator==(const MarchLines& other) const;
};

/// A comparison that ends the loop after a number of iterations when its result is `stopping`.
struct TurnLimit {
    NodeId test = k_no_node;
    bool stopping = false;
};

struct MarchNodes {
    NodeId loop = k_no_node;
    NodeId test = k_no_node;
    NodeId distance = k_no_node, threshold = k_no_node; ///< sides of the test
    bool in_head = false;      ///< the test is in the loop's head, which is evaluated before its body
    std::string place;         ///< the text of the variable that moves along the ray
    bool place_before = false; ///< that variable is declared before the loop
    std::vector<TurnLimit> limits;
};

/// Returns the nodes; the error says what is not certain, and where.
Result<MarchNodes> find_march(const ParsedText& text, const TreeFacts& facts, const MarchLines& lines);

/// Returns the loop's body.
NodeId body_of(const SyntaxTree& tree, NodeId loop);
/// Returns the loop's condition; k_no_node: it has none.
NodeId head_of(const SyntaxTree& tree, NodeId loop);

} // namespace tidemark::glsl
