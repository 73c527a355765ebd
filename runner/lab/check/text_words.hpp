// Describes the findings of glsl/analysis for messages. Used by the probes of texts, by fixes and by the
// language server.
#pragma once

#include "glsl/analysis/divergence.hpp"
#include "glsl/analysis/unassigned.hpp"
#include "glsl/flow/float_counter.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// Returns, for example, `, on some path`, to follow the name of the variable without a value.
std::string_view words_for(glsl::Unassigned::Why why);
/// Returns the token of the text that the finding points to.
size_t word_without_value(const glsl::ParsedText& text, const glsl::Unassigned& each);

/// Returns, for example, `sum (a.glsl:4)` or `hit (a.glsl:9, an `out` that some path does not write)`; empty
/// if the place is in generated text.
std::string sentence_for(const glsl::ParsedText& text, const glsl::Unassigned& each);

/// Returns, for example, `texture needs neighbouring pixels, which may have taken another branch: …`.
std::string words_for(const glsl::ParsedText& text, const glsl::Divergent& each);
/// Returns, for example, `x counts 11 turns, where its numbers make 10: each step is rounded`.
std::string words_for(const glsl::FloatCounter& counter);

/// Returns, for example, `neighbours may branch at a.glsl:3` or `called after the return at a.glsl:4`.
std::string words_for(const glsl::ParsedText& text, const glsl::DivergentBranch& branch);

/// Returns a predicate that is true for the names of samplers with mipmaps. `pass` must outlive it.
std::function<bool(std::string_view sampler)> which_have_mipmaps(const scene::Pass& pass);

} // namespace tidemark::lab
