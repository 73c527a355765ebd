// Hashes of bits in the place of those of large sines, `fract(sin(dot(p, k)) * c)` and their kind, which are
// other numbers on every GPU. They are other numbers than the sines', too, and the same everywhere.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// All that can be written anew, file by file: a function that hashes, in front of the first that calls it,
/// and the calls. Left are hashes of what is neither a variable of one float nor a dot product, or vectors of
/// these.
std::vector<Cure> whole_hashes(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
