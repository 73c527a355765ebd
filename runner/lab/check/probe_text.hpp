// The texts of a scene's passes as a probe reads them. A context must be current.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"
#include "lab/check/probe_bench.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tidemark::lab {

/// One pass that is drawn, cubemaps left out.
struct PassText {
    size_t pass = 0;
    std::unique_ptr<const glsl::ParsedText> text;
    glsl::TreeFacts facts;
};

/// `as_written`: as lab/trace/watched_run.hpp has it. Fails where a text cannot be followed.
Result<std::vector<PassText>> read_texts(ProbeBench& bench, bool as_written);

/// `waves.glsl:12`, of a word; empty for a line of our own.
std::string place_of(const glsl::ParsedText& text, size_t word);

/// `a, b and 3 more`.
std::string listed(const std::vector<std::string>& names);

} // namespace tidemark::lab
