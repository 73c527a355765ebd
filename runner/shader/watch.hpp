// Instruments a shader to find the origin of a NaN or an infinity: every operation of the author's text that
// can make one goes through a function that records the first that did. Text in, text out; the record goes
// into a buffer of uints whose layout is defined here.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Nodes to watch and nodes to change; a node is identified by its number in the tree.
struct WatchRequest {
    enum class Reach {
        statements, ///< values that statements store, return and pass on: cheap
        operations, ///< every operation inside `within`
        everything,
    };
    Reach reach = Reach::statements;
    NodeId within = k_no_node;
    /// The node inside `within` whose operands, loops and calls are recorded.
    NodeId capture = k_no_node;
    std::vector<NodeId> repaired; ///< nodes that return 0.5 instead of a value that is not finite
    bool nan_only = false;        ///< infinities are not recorded
    /// Above 0: pixels per row of a whole picture. Element x + y * width is the first hit of that pixel.
    int map_width = 0;
};

/// Elements of the buffer when one pixel is watched.
struct WatchLayout {
    static constexpr size_t k_arrived = 0; ///< 1: the shader ran to its end or to a discard
    static constexpr size_t k_hit = 1;     ///< the node; 0: none
    static constexpr size_t k_value = 2;   ///< a slot: its type, then up to 16 numbers as bits
    static constexpr size_t k_slot = 17;
    static constexpr size_t k_depth = 19; ///< number of open calls
    static constexpr size_t k_path = 20;  ///< nodes of the open calls, outermost first
    static constexpr size_t k_most_calls = 32;
    static constexpr size_t k_loops = 52; ///< iterations of Watch::loops, counted from 1
    static constexpr size_t k_most_loops = 64;
    static constexpr size_t k_operands = 116; ///< slots
    static constexpr size_t k_most_operands = 8;
    static constexpr size_t k_words = k_operands + k_most_operands * k_slot;
};

/// Returns the type of a slot. Codes: scalars and vectors by their index in k_vectors, from 1; matrices as
/// 100 + 10 * columns + rows; 0: empty.
std::optional<ValueType> slot_type(unsigned code);
inline constexpr int k_matrix_slot = 100;

struct Watch {
    std::string text;
    std::vector<NodeId> operands; ///< operands of `capture` that have a slot, in the order of the slots
    std::vector<NodeId> loops;    ///< loops that are counted
};

/// Binding of the buffer.
inline constexpr unsigned k_watch_binding = 0;

/// Instruments `text`; `facts` are those of `text`. Cannot fail: operations that cannot be watched stay as
/// they are.
Watch watch(const ParsedText& text, const TreeFacts& facts, const WatchRequest& request);

// Instruments a shader so that it shows the value of one of its expressions instead of the picture: the last
// value in each pixel, or NaN where the expression was not evaluated. A uniform selects it. Text in, text
// out.

struct SeenValues {
    std::string text;          ///< empty: the text has its author's own `main`, whose output is unknown
    std::string which_uniform; ///< int, an index into the expressions
};

/// `expressions` are floats and vectors of floats; `output` is the variable that our `main` writes.
SeenValues see_values(const ParsedText& text, std::span<const NodeId> expressions, std::string_view output);

} // namespace tidemark::glsl
