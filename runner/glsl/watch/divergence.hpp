// Derivatives taken where neighbouring pixels may have gone another way: undefined, for a derivative is a
// difference to a neighbour. Asked for by name, or by a texture that chooses its mipmap.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <functional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

struct Divergent {
    NodeId call = k_no_node;
    NodeId condition = k_no_node; ///< that pixels may answer differently; none: of a call on the way
};

/// In functions that `main` comes to, in the order of the text. A value may differ between pixels if it is
/// made of gl_FragCoord on some way; variables are told apart by name alone. What stands behind an early
/// return is not held against it.
std::vector<Divergent> find_divergent(const ParsedText& text, const TreeFacts& facts,
                                      const std::function<bool(std::string_view sampler)>& has_mipmaps);

} // namespace tidemark::glsl
