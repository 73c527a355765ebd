// Parsed texts of passes, and the wording of findings about them.
//
// The parsed texts of a scene's passes, for probes. A context must be current.
#pragma once

#include "lab/probe_bench.hpp"
#include "scene/scene.hpp"
#include "shader/domain_watch.hpp"
#include "shader/loops.hpp"
#include "shader/parsed_text.hpp"
#include "shader/source_edits.hpp"
#include "shader/tree_facts.hpp"
#include "shader/undefined_behaviour.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// The text of one drawn pass.
struct PassText {
    size_t pass = 0;
    std::unique_ptr<const glsl::ParsedText> text;
    glsl::TreeFacts facts;
};

/// Parses the texts of all drawn passes except cubemaps. `as_written` as in lab/instrumented_pass.hpp. Fails
/// if a text cannot be parsed.
Result<std::vector<PassText>> read_texts(ProbeBench& bench, bool as_written);

/// Returns the place of a token, such as `waves.glsl:12`; empty for a line that Tidemark generated.
std::string place_of(const glsl::ParsedText& text, size_t word);

/// Joins up to four names: `a, b, c, d and 3 more`.
std::string listed(const std::vector<std::string>& names);

// Describes the findings of shader/undefined_behaviour.hpp and shader/loops.hpp for messages. Used by the
// probes of texts, by fixes and by the language server.

/// Returns, for example, `, on some path`, to follow the name of the variable without a value.
std::string_view words_for(glsl::Unassigned::Why why);
/// Returns the token of the text that the finding points to.
size_t word_without_value(const glsl::ParsedText& text, const glsl::Unassigned& each);

/// Returns, for example, `sum (a.glsl:4)` or `hit (a.glsl:9, an `out` that some path does not write)`; empty
/// if the place is in generated text.
std::string sentence_for(const glsl::ParsedText& text, const glsl::Unassigned& each);

/// Returns, for example, "`clamp(x, 1.0, 0.0)` (a.glsl:4, its low edge is above its high one)"; empty in
/// generated text.
std::string sentence_for(const glsl::ParsedText& text, const glsl::WrongEdges& each);

/// A line in the picture where a look-up's coordinates jump: pixels there read a mipmap that is too small.
struct Seam {
    std::string place; ///< `a.glsl:4`
    SourceLocation location;
    std::string sentence; ///< place, look-up, and how much of the picture changes without the jump
    FrameState where;
    image::Image picture; ///< the difference
    glsl::Cure cure;
};
/// Returns the seams that show at 1 s. `texts` come from read_texts with as_written = true.
Result<std::vector<Seam>> find_seams(ProbeBench& bench, const std::vector<PassText>& texts);

/// Returns, for example, `texture needs neighbouring pixels, which may have taken another branch: …`.
std::string words_for(const glsl::ParsedText& text, const glsl::Divergent& each);
/// Returns, for example, `x counts 11 turns, where its numbers make 10: each step is rounded`.
std::string words_for(const glsl::FloatCounter& counter);

/// Returns, for example, `neighbours may branch at a.glsl:3` or `called after the return at a.glsl:4`.
std::string words_for(const glsl::ParsedText& text, const glsl::DivergentBranch& branch);

/// Returns a predicate that is true for the names of samplers with mipmaps. `pass` must outlive it.
std::function<bool(std::string_view sampler)> which_have_mipmaps(const scene::Pass& pass);

// Describes, for messages, a value that left a function's or operator's domain. Readings of an instrumented
// text in, text out.

/// Returns whether the site is an index, a shift, a whole-number divisor, a texel or a conversion rather than
/// a function of floats.
bool is_bound(const glsl::DomainSite& site, const glsl::DomainReading& reading);

/// Returns the start of a message, such as "`a[i]`: index 7 outside of 0 to 4" or, with an open parenthesis
/// that the caller closes, "pow of a negative number (-0.5".
std::string domain_sentence(const glsl::ParsedText& text, const glsl::DomainSite& site,
                            const glsl::DomainReading& reading);

/// Returns `waves.glsl:12`; empty for a line that Tidemark generated.
std::string place_of_site(const glsl::ParsedText& text, const glsl::DomainSite& site);
SourceLocation location_of_site(const glsl::ParsedText& text, const glsl::DomainSite& site);

} // namespace tidemark::lab
