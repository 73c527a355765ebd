// What glsl/analysis finds in a text, in words: for the probes of a text, and for whoever reads it beside
// them.
#pragma once

#include "glsl/analysis/divergence.hpp"
#include "glsl/analysis/unassigned.hpp"
#include "glsl/flow/float_counter.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// `, on some path`: behind the name of what has no value.
std::string_view words_for(glsl::Unassigned::Why why);
/// The word of a text that it is about.
size_t word_without_value(const glsl::ParsedText& text, const glsl::Unassigned& each);

/// `sum (a.glsl:4)`, `hit (a.glsl:9, an `out` that some path does not write)`; empty: not the author's.
std::string sentence_for(const glsl::ParsedText& text, const glsl::Unassigned& each);

/// `texture needs neighbouring pixels, which may have taken another branch: …`.
std::string words_for(const glsl::ParsedText& text, const glsl::Divergent& each);
/// `x counts 11 turns, where its numbers make 10: each step is rounded`.
std::string words_for(const glsl::FloatCounter& counter);

/// `neighbours may branch at a.glsl:3`, `called after the return at a.glsl:4`.
std::string words_for(const glsl::ParsedText& text, const glsl::DivergentBranch& branch);

/// Which samplers of a pass have mipmaps, by name. The pass must live as long.
std::function<bool(std::string_view sampler)> which_have_mipmaps(const scene::Pass& pass);

} // namespace tidemark::lab
