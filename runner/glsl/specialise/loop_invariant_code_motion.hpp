// Costly expressions of uniforms that a loop works out again in every turn are worked out once a pixel, as
// global variables with a value. llvmpipe does not do so by itself.
#pragma once

#include "glsl/specialise/globals.hpp"
#include "glsl/syntax/word_edits.hpp"

#include <vector>

namespace tidemark::glsl {

/// Adds to `edits`; how many expressions. `gone` words and globals that are not `reached` are left alone.
int move_loop_invariants(const ParsedText& text, const std::vector<Global>& globals,
                         const std::vector<bool>& reached, const std::vector<bool>& gone, WordEdits& edits);

} // namespace tidemark::glsl
