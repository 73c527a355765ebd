// Rewrite rules as tools for the accuracy of expressions have them (P. Panchekha et al., Herbie, PLDI 2015):
// what is written instead is equal in real arithmetic and has no small difference of large numbers. Whether a
// picture is nearer to that in double by it is for who draws it.
#pragma once

#include "glsl/cure/written.hpp"

#include <vector>

namespace tidemark::glsl {

/// One for each place where a rule applies, in the order of the text.
std::vector<Cure> rewrites(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
