// What a text reads that may not have a value yet, and functions that may come to their end without one:
// undefined, but where a site begins with zeros.
#pragma once

#include "glsl/flow/assigned.hpp"

#include <vector>

namespace tidemark::glsl {

struct Unassigned {
    enum class Why : unsigned char {
        never,            ///< nothing writes the variable
        on_some_way,      ///< some way to the read leaves it, or a part of it, without
        not_given,        ///< an `out` parameter that nothing writes
        left_on_some_way, ///< an `out` parameter that some way to the function's end leaves without
        no_return         ///< some way to the function's end gives nothing back
    };
    Why why = Why::never;
    NodeId what = k_no_node; ///< declarator, parameter or function
    NodeId at = k_no_node;   ///< the first read; the `return` or the body's block; the function
};

/// In functions that `main` comes to, in the order of the text. Says nothing where overloads leave it open
/// whether an argument is written.
std::vector<Unassigned> find_unassigned(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
