#include "cli/finding.hpp"

#include "base/file.hpp"
#include "text/mapped_text.hpp"
#include "text/token_at.hpp"

#include <utility>

namespace tidemark::cli {
namespace {

Rule rule_of(ErrorCode code) {
    switch (code) {
    case ErrorCode::check_failed: return {"check", "A check or a comparison passes"};
    case ErrorCode::usage: return {"usage", "The command line asks for something that there is"};
    case ErrorCode::load: return scene_rule();
    case ErrorCode::write: return {"output", "The output can be written"};
    case ErrorCode::no_memory: return {"memory", "The machine and its driver have the memory that it takes"};
    case ErrorCode::timed_out: return {"limits", "Compiling and drawing keep to --timeout and --memory"};
    case ErrorCode::no_context: return {"driver", "There is an OpenGL driver that works"};
    }
    return scene_rule();
}

} // namespace

Rule scene_rule() {
    return {"scene", "The scene loads and its passes compile"};
}

Finding finding_of(Diagnostic diagnostic, Rule rule) {
    Finding finding{.diagnostic = std::move(diagnostic), .rule = std::move(rule)};
    const SourceLocation& where = finding.diagnostic.where;
    if (where.column > 0)
        if (const auto file = read_text_file(where.file)) {
            const std::string text = text::with_plain_line_ends(*file);
            finding.line = text::line_of(text, where.line);
            finding.end_column = text::end_of_token(finding.line, where.column);
        }
    return finding;
}

std::vector<Finding> findings_of(const Error& error) {
    std::vector<Finding> findings;
    for (const Diagnostic& diagnostic : error.diagnostics)
        findings.push_back(finding_of(diagnostic, rule_of(error.code)));
    if (findings.empty())
        findings.push_back({.diagnostic = {{}, Severity::error, error.message}, .rule = rule_of(error.code)});
    return findings;
}

} // namespace tidemark::cli
