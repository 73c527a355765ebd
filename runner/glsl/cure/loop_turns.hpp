// Changes the number of iterations of a loop whose text states it as a literal.
#pragma once

#include "glsl/cure/written.hpp"
#include "glsl/flow/loop_bound.hpp"

#include <optional>

namespace tidemark::glsl {

/// Replaces the number that `bound` counts to, so that the loop has `turns` iterations. Returns nothing if
/// there is no such number or if it cannot be changed in the text.
std::optional<Wrap> with_turns(const ParsedText& text, const LoopBound& bound, double turns);

} // namespace tidemark::glsl
