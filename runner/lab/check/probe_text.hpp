// The parsed texts of a scene's passes, for probes. A context must be current.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"
#include "lab/check/probe_bench.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The text of one drawn pass.
struct PassText {
    size_t pass = 0;
    std::unique_ptr<const glsl::ParsedText> text;
    glsl::TreeFacts facts;
};

/// Parses the texts of all drawn passes except cubemaps. `as_written` as in lab/trace/watched_run.hpp. Fails
/// if a text cannot be parsed.
Result<std::vector<PassText>> read_texts(ProbeBench& bench, bool as_written);

/// Returns the place of a token, such as `waves.glsl:12`; empty for a line that Tidemark generated.
std::string place_of(const glsl::ParsedText& text, size_t word);

/// Joins up to four names: `a, b, c, d and 3 more`.
std::string listed(const std::vector<std::string>& names);

} // namespace tidemark::lab
