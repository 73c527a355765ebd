#include "cli/lsp/hints.hpp"

#include "cli/site_refusals.hpp"
#include "glsl/portability.hpp"
#include "lab/check/text_words.hpp"
#include "lab/trace/watched_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tidemark::cli {
namespace {

bool is_error(const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::error;
}

} // namespace

/// Adds a hint once. Ignores lines without a file: those are generated.
void Hints::add(SourceLocation where, std::string message) {
    Diagnostic hint{std::move(where), Severity::note, std::move(message)};
    if (!hint.where.file.empty() && std::ranges::find(found_, hint) == found_.end())
        found_.push_back(std::move(hint));
}

void Hints::read(const scene::Pass& pass, const glsl::Dialect& dialect) {
    const auto text = lab::read_text(scene_, pass, dialect, true);
    if (!text)
        return; // the driver accepts some texts that the analysis cannot follow
    const glsl::TreeFacts facts = glsl::find_facts(**text);
    for (const glsl::Unassigned& each : glsl::find_unassigned(**text, facts))
        add((*text)->spelled(lab::word_without_value(**text, each)),
            fmt::format("{} has no value{}: 0 on ShaderToy's site and here, anything elsewhere",
                        (*text)->word_of(each.what), lab::words_for(each.why)));
    for (const glsl::Divergent& each : glsl::find_divergent(**text, facts, lab::which_have_mipmaps(pass)))
        add((*text)->spelled((*text)->tree()[each.call].begin), lab::words_for(**text, each));
    for (const glsl::FloatCounter& each : glsl::miscounting_loops(**text, facts))
        add((*text)->spelled((*text)->tree()[each.loop].begin), lab::words_for(each));
}

std::vector<Diagnostic> Hints::take(const std::vector<Diagnostic>& problems, bool compile) {
    std::vector<Diagnostic> unportable = glsl::portability_lint(scene_);
    if (compile && std::ranges::none_of(problems, is_error))
        add_site_refusals(scene_, unportable);
    for (Diagnostic& each : unportable)
        add(std::move(each.where), "not portable to ShaderToy's site: " + each.message);
    std::erase_if(found_, [&](const Diagnostic& hint) {
        return std::ranges::any_of(problems, [&](const Diagnostic& problem) {
            return problem.where.file == hint.where.file && problem.where.line == hint.where.line;
        });
    });
    return std::move(found_);
}

} // namespace tidemark::cli
