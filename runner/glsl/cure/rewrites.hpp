// Proposes rewrites like those of tools for accurate expressions (P. Panchekha et al., Herbie, PLDI 2015):
// the new text is equal in real arithmetic and avoids a small difference of large numbers. The caller
// measures whether it brings the picture nearer to the one in double precision.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// Returns one fix per place where a rule applies, in the order of the text.
std::vector<Cure> rewrites(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
