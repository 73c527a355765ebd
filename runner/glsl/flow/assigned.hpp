// Finds variables that may be read before they have a value. Follows all paths through every function,
// separately for each part of structures, vectors and small arrays, and follows global variables through
// calls. Sound: a part reported as assigned is assigned on every path that the text allows. Does not evaluate
// conditions, except those of simple loops.
#pragma once

#include "glsl/flow/shape.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <vector>

namespace tidemark::glsl {

/// A variable that is declared without a value although its type can have one.
struct UnsetVariable {
    NodeId type = k_no_node;
    NodeId declared = k_no_node; ///< declarator, or an `out` parameter
    const Shape* shape = nullptr;
    bool global = false;
    bool parameter = false;
    bool written = false;  ///< the text writes some part of it
    bool runs = true;      ///< `main` reaches its function
    bool doubtful = false; ///< written only by some overloads of a function
    /// First read of a part that some path leaves without a value; k_no_node if there is no such read.
    NodeId read = k_no_node;
    /// For a parameter: the `return` at which a part may have no value; the body if it is the end of the
    /// body.
    NodeId left = k_no_node;

    bool needs_value() const { return runs && (read != k_no_node || left != k_no_node); }
};

struct Assignment {
    std::vector<UnsetVariable> variables; ///< in text order
    /// Functions reached from `main` that return a value on some path, but may reach their end without a
    /// return.
    std::vector<NodeId> without_return;
};

/// Analyses the whole text. Without a `main`, every function counts as reached. `shapes` must belong to the
/// same text.
Assignment find_assignment(const ParsedText& text, const TreeFacts& facts, Shapes& shapes);

} // namespace tidemark::glsl
