// Replaces hashes of large sines, `fract(sin(dot(p, k)) * c)` and similar, whose values differ between GPUs,
// by hashes of bits. Their values differ from the sines', too, but are the same on every GPU.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// Returns one fix per file: a hash function before the first function that calls it, and the calls. Leaves
/// hashes whose argument is neither a float variable nor a dot product, nor a vector of dot products.
std::vector<Cure> whole_hashes(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
