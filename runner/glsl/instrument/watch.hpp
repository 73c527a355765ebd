// An instrumented shader that finds the origin of a NaN or an infinity: every operation of the author's text
// that can make one goes through a function of ours, which remembers the first that did. Text in, text out;
// what is remembered goes into a buffer of words whose layout stands here.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::glsl {

/// What to watch, and what to change. A node that is watched is known by its number in the tree.
struct WatchRequest {
    enum class Reach {
        statements, ///< what statements store, return and pass on: cheap
        operations, ///< every operation below `within`
        everything,
    };
    Reach reach = Reach::statements;
    NodeId within = k_no_node;
    /// Its operands are written down, with loops and calls on the way. Below `within`.
    NodeId capture = k_no_node;
    std::vector<NodeId> repaired; ///< give 0.5 where they are not finite
    bool nan_only = false;        ///< infinities are no news
    /// Above 0: a whole picture of so many pixels a row. Word x + y * width is the first hit of that pixel.
    int map_width = 0;
};

/// Words of the buffer when one pixel is watched.
struct WatchLayout {
    static constexpr size_t k_arrived = 0; ///< 1: the shader ran to its end or to a discard
    static constexpr size_t k_hit = 1;     ///< the node; 0: none
    static constexpr size_t k_value = 2;   ///< a slot: its type, then up to 16 numbers as bits
    static constexpr size_t k_slot = 17;
    static constexpr size_t k_depth = 19; ///< calls that were open
    static constexpr size_t k_path = 20;  ///< their nodes, outermost first
    static constexpr size_t k_most_calls = 32;
    static constexpr size_t k_loops = 52; ///< iterations of Watch::loops, from 1
    static constexpr size_t k_most_loops = 64;
    static constexpr size_t k_operands = 116; ///< slots
    static constexpr size_t k_most_operands = 8;
    static constexpr size_t k_words = k_operands + k_most_operands * k_slot;
};

/// The type of a slot: scalars and vectors by their place in k_vectors, from 1; matrices as 100 + 10 *
/// columns + rows; 0, and nothing, where none was written.
std::optional<ValueType> slot_type(unsigned code);
inline constexpr int k_matrix_slot = 100;

struct Watch {
    std::string text;
    std::vector<NodeId> operands; ///< those of `capture` that have a slot, in the order of the slots
    std::vector<NodeId> loops;    ///< those that are counted
};

/// Where the buffer is bound.
inline constexpr unsigned k_watch_binding = 0;

/// Watches `text`; `facts` are its own. Cannot fail: what cannot be watched is left as it is.
Watch watch(const ParsedText& text, const TreeFacts& facts, const WatchRequest& request);

} // namespace tidemark::glsl
