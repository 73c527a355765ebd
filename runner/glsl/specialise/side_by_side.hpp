// Calls of one function in one expression, `f(a) + f(b)`, run side by side: one function with the statements
// of `f` twice, in turns. The values are those of the calls, operation by operation. One after the other, the
// chain of the first fills the few dozen operations that a processor keeps waiting, and the second, which
// waits for nothing, cannot begin; compilers keep the order of the text.
#pragma once

#include "glsl/syntax/word_edits.hpp"

namespace tidemark::glsl {

/// Adds to `edits`; how many expressions.
int run_side_by_side(const ParsedText& text, WordEdits& edits);

} // namespace tidemark::glsl
