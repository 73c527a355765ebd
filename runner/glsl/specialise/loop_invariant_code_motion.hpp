// Moves costly expressions of uniforms out of loops into global variables with a value, which are computed
// once per pixel. llvmpipe does not do this itself.
#pragma once

#include "glsl/specialise/globals.hpp"
#include "glsl/syntax/word_edits.hpp"

#include <vector>

namespace tidemark::glsl {

/// Adds the changes to `edits` and returns the number of moved expressions. Leaves `gone` tokens and globals
/// that are not `reached`.
int move_loop_invariants(const ParsedText& text, const std::vector<Global>& globals,
                         const std::vector<bool>& reached, const std::vector<bool>& gone, WordEdits& edits);

} // namespace tidemark::glsl
