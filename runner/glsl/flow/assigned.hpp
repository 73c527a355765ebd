// Which variables may be read before they have a value: follows every way through every function, part by
// part of structures, vectors and small arrays, and global variables through calls. Sound: what it calls
// assigned is assigned on every way that the text leaves open. It knows no values of conditions.
#pragma once

#include "glsl/flow/shape.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <vector>

namespace tidemark::glsl {

/// A variable that is declared without a value, and can have one.
struct UnsetVariable {
    NodeId type = k_no_node;
    NodeId declared = k_no_node; ///< declarator, or parameter: `out`
    const Shape* shape = nullptr;
    bool global = false;
    bool parameter = false;
    bool written = false;  ///< at all
    bool runs = true;      ///< `main` comes to its function
    bool doubtful = false; ///< overloads of a function tell whether it is written
    /// The first read of a part that some way to there leaves without a value; none: there is no such read.
    NodeId read = k_no_node;
    /// Of a parameter: the `return` where a part may still be without; where the body just ends, the body.
    NodeId left = k_no_node;

    bool needs_value() const { return runs && (read != k_no_node || left != k_no_node); }
};

struct Assignment {
    std::vector<UnsetVariable> variables; ///< in the order of the text
    /// Functions that `main` comes to and that give a value back on some way, and may come to their end
    /// without.
    std::vector<NodeId> without_return;
};

/// Where there is no `main`, every function runs. `shapes` made of the same text.
Assignment find_assignment(const ParsedText& text, const TreeFacts& facts, Shapes& shapes);

} // namespace tidemark::glsl
