// Finds the number that ends a loop, if its head has one: `i < 64`, `i++ < 1e2`, `i < 64 && t < 20.0`.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"
#include "shader/variables.hpp"
#include "shader/vocabulary.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

struct LoopBound {
    NodeId number = k_no_node; ///< literal upper limit of a counter with step 1; k_no_node if there is none
    double first = 0;          ///< start value
    double turns = 0;          ///< iterations; valid if there is a number
};

/// Returns nothing for a loop that its head does not certainly end (provided that the body does not change
/// the counter). A counter without a value in the head starts at 0.
std::optional<LoopBound> loop_bound(const ParsedText& text, NodeId loop);

/// Returns the body of any loop.
NodeId body_of_loop(const SyntaxTree& tree, NodeId loop);
/// Returns the condition of any loop; k_no_node if it has none.
NodeId loop_condition(const ParsedText& text, NodeId loop);

// Finds loops whose float counter has rounding errors: `for (float x = 0.0; x < 1.0; x += 0.01)` has 101
// iterations, since 100 rounded steps add up to less than 1.

struct FloatCounter {
    NodeId loop = k_no_node;
    std::string_view name;
    NodeId first = k_no_node, step = k_no_node; ///< start value and step
    bool down = false;                          ///< `-=`
    /// iterations in floats; infinite if a step is lost in rounding
    double turns = 0;
    double exact_turns = 0; ///< iterations in real arithmetic
};

/// Returns the loops that have another number of iterations in floats than in real arithmetic, in text order.
/// Covers only loops with literal numbers whose head declares, tests and steps the counter, and whose body
/// does not change it.
std::vector<FloatCounter> miscounting_loops(const ParsedText& text, const TreeFacts& facts);

// Facts from the head of a `for` loop: whether its body certainly runs, and whether it covers a whole array.

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

// How loops end: how many iterations they may have, and instruments that record whether a driver cut one.

/// Returns the comparison in the loop's head that ends it by counting, `i < N`; k_no_node if there is none.
NodeId counter_test(const ParsedText& text, NodeId loop);

/// Returns an upper bound of the iterations of all loops of one pixel together, as the numbers of the loops'
/// heads state it; infinity if a loop has no such number.
double most_iterations(const ParsedText& text, const TreeFacts& facts);

/// A text that records for each of its loops how it ended.
struct LoopEnds {
    std::string text;
    std::vector<NodeId> loops{};
    size_t words() const { return 2 * loops.size(); }
    /// Indices into the buffer (k_watch_binding). A word is 1 if loop `i` ended although its condition held
    /// and it was not left: the driver cut it.
    static size_t cut(size_t i) { return 2 * i; }
    /// A word is 1 if a count ended loop `i`: the bound in its head, or an integer that its body tests.
    static size_t counted_out(size_t i) { return 2 * i + 1; }
};
LoopEnds record_loop_ends(const ParsedText& text, const TreeFacts& facts);

// Pixels that leave a loop within an iteration, by `break` or `return`.

/// A loop with such a statement, and the variables from outside that its iterations set.
struct LeftLoop {
    struct Variable {
        std::string name; ///< of a structure's member: `ray.from`
        ValueType type;   ///< a number or a vector
    };
    NodeId body = k_no_node;
    std::vector<NodeId> continues; ///< statements
    std::vector<Variable> variables;
};
/// Returns these loops, in text order. Leaves out variables whose names have several types.
std::vector<LeftLoop> left_loops(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
