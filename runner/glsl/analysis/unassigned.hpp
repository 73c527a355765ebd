// Finds variables that may be read before they have a value, and functions that may end without a return
// value. Both are undefined in GLSL; ShaderToy's site uses zeros.
#pragma once

#include "glsl/flow/assigned.hpp"

#include <vector>

namespace tidemark::glsl {

struct Unassigned {
    enum class Why : unsigned char {
        never,            ///< nothing writes the variable
        on_some_way,      ///< some path to the read leaves it, or a part of it, unset
        not_given,        ///< an `out` parameter that nothing writes
        left_on_some_way, ///< an `out` parameter that some path to the function's end leaves unset
        no_return         ///< some path to the function's end returns no value
    };
    Why why = Why::never;
    NodeId what = k_no_node; ///< declarator, parameter or function
    NodeId at = k_no_node;   ///< the first read, the `return` or body, or the function itself
};

/// Returns the faults in functions reachable from `main`, in the order of the text. Reports nothing if
/// overloads leave it open whether an argument is written.
std::vector<Unassigned> find_unassigned(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
