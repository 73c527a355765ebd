// Finds derivatives, explicit or by a texture look-up that chooses its mipmap, at places that neighbouring
// pixels may not reach. They are undefined there, because a derivative is a difference to a neighbour.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <functional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// The place that separates the pixels that reach a node from their neighbours.
struct DivergentBranch {
    NodeId at =
        k_no_node;       ///< a condition; with `exit` a return, discard, continue, or a call that discards
    bool exit = false;   ///< the node comes after `at`, where some pixels left
    bool called = false; ///< the separation happens before a call of the function that holds the node
};

struct Divergent {
    NodeId call = k_no_node;
    DivergentBranch branch;
};

/// Returns such calls in functions reachable from `main`, in the order of the text. A value may differ
/// between pixels if gl_FragCoord contributes to it in any way; variables are distinguished by name alone.
/// GLSL 4.60, 6.4: "subsequent implicit or explicit derivatives are undefined when this control flow is
/// non-uniform", for a discard as for a return.
std::vector<Divergent> find_divergent(const ParsedText& text, const TreeFacts& facts,
                                      const std::function<bool(std::string_view sampler)>& has_mipmaps);

} // namespace tidemark::glsl
