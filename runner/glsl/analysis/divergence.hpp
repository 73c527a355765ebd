// Derivatives taken where neighbouring pixels may have gone another way: undefined, for a derivative is a
// difference to a neighbour. Asked for by name, or by a texture that chooses its mipmap.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <functional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// What divides the pixels that come to a place from their neighbours.
struct DivergentBranch {
    NodeId at =
        k_no_node;       ///< a condition; with `exit` a return, discard or continue, or a call that discards
    bool exit = false;   ///< the place is behind it, and some pixels left there
    bool called = false; ///< it divides them before the function is called that the place is in
};

struct Divergent {
    NodeId call = k_no_node;
    DivergentBranch branch;
};

/// In functions that `main` comes to, in the order of the text. A value may differ between pixels if it is
/// made of gl_FragCoord on some way; variables are told apart by name alone. GLSL 4.60, 6.4: "subsequent
/// implicit or explicit derivatives are undefined when this control flow is non-uniform", of a discard as of
/// a return.
std::vector<Divergent> find_divergent(const ParsedText& text, const TreeFacts& facts,
                                      const std::function<bool(std::string_view sampler)>& has_mipmaps);

} // namespace tidemark::glsl
