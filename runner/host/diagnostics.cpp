// Formats findings as a SARIF 2.1.0 log, which code scanning and editors read.

#include "host/diagnostics.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "base/mapped_text.hpp"
#include "base/tokens.hpp"
#include "host/console.hpp"
#include "host/json.hpp"
#include "host/requests.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <mutex>
#include <span>
#include <utility>

namespace tidemark::host {
namespace {

Rule rule_of(ErrorCode code) {
    switch (code) {
    case ErrorCode::check_failed: return {"check", "A check or a comparison passes"};
    case ErrorCode::usage: return {"usage", "The command line is valid"};
    case ErrorCode::load: return scene_rule();
    case ErrorCode::write: return {"output", "The output can be written"};
    case ErrorCode::no_memory: return {"memory", "The machine and its driver have enough memory"};
    case ErrorCode::timed_out: return {"limits", "Compiling and drawing stay within --timeout and --memory"};
    case ErrorCode::no_context: return {"driver", "A working OpenGL driver is available"};
    }
    return scene_rule();
}

/// The name of a pass in a JSON project is `waves.json:Image`.
constexpr std::string_view k_project = ".json:";

/// Lines of a pass's text in a project are not lines of the file, so the region is omitted.
Json location_in_project(const SourceLocation& where, size_t project_end) {
    return {{"physicalLocation",
             {{"artifactLocation", {{"uri", uri_reference(where.file.substr(0, project_end))}}}}},
            {"logicalLocations",
             Json::array({{{"name", where.file.substr(project_end + 1)},
                           {"fullyQualifiedName", fmt::format("{}:{}", where.file, where.line)}}})}};
}

/// Converts a column from bytes to UTF-16 units.
size_t column_of(const Finding& finding, int column) {
    return finding.line.empty() ? size_t(column)
                                : 1 + text::utf16_length(finding.line.substr(0, size_t(column) - 1));
}

Json location_of(const Finding& finding) {
    const SourceLocation& where = finding.diagnostic.where;
    if (const size_t at = where.file.find(k_project); at != where.file.npos)
        return location_in_project(where, at + k_project.size() - 1);
    Json region = {{"startLine", std::max(where.line, 1)}};
    if (where.column > 0)
        region["startColumn"] = column_of(finding, where.column);
    if (finding.end_column > 0)
        region["endColumn"] = column_of(finding, finding.end_column);
    return {{"physicalLocation",
             {{"artifactLocation", {{"uri", uri_reference(where.file)}}}, {"region", std::move(region)}}}};
}

Json result_of(const Finding& finding, size_t rule) {
    Json result = {{"ruleId", finding.rule.id},
                   {"ruleIndex", rule},
                   {"level", to_string(finding.diagnostic.severity)},
                   {"message", {{"text", finding.diagnostic.message}}}};
    if (!finding.diagnostic.where.file.empty())
        result["locations"] = Json::array({location_of(finding)});
    return result;
}

/// Returns a log with one run of this program. File names become URIs, relative if the name is.
Json sarif_log(std::span<const Finding> findings) {
    std::vector<Rule> rules;
    Json results = Json::array();
    for (const Finding& finding : findings) {
        const auto known = std::ranges::find(rules, finding.rule);
        results.push_back(result_of(finding, size_t(known - rules.begin())));
        if (known == rules.end())
            rules.push_back(finding.rule);
    }
    Json described = Json::array();
    for (const Rule& rule : rules)
        described.push_back({{"id", rule.id}, {"shortDescription", {{"text", rule.about}}}});
    return {
        {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
        {"version", "2.1.0"},
        {"runs",
         Json::array({{{"tool",
                        {{"driver",
                          {{"name", "Tidemark"}, {"version", k_version}, {"rules", std::move(described)}}}}},
                       {"columnKind", "utf16CodeUnits"},
                       {"results", std::move(results)}}})}};
}

enum class Form { people, gcc, json, sarif };

/// The state of `say`: standard error and its form exist once per process.
struct Sink {
    std::mutex mutex; ///< the watchdog reports from its own thread
    Form form = Form::people;
    std::string scene{};          ///< as on the command line
    std::vector<Finding> waiting; ///< SARIF findings, until the end of the run
};
Sink& sink() {
    static Sink the_one;
    return the_one;
}

/// Formats a diagnostic in GNU's format with all parts, so that one pattern matches every line; a diagnostic
/// about a whole file gets line 1, column 1.
std::string to_gcc(const Diagnostic& diagnostic) {
    Diagnostic whole = diagnostic;
    SourceLocation& where = whole.where;
    where = where.file.empty()
                ? SourceLocation{"tidemark"}
                : SourceLocation{where.file, std::max(where.line, 1), std::max(where.column, 1)};
    return to_string(whole);
}

std::string to_json_line(const Finding& finding) {
    const auto& [where, severity, message] = finding.diagnostic;
    return dump({{"file", where.file},
                 {"line", where.line},
                 {"column", where.column},
                 {"end_column", finding.end_column},
                 {"severity", to_string(severity)},
                 {"rule", finding.rule.id},
                 {"message", message}});
}

void choose(const std::string& name) {
    constexpr std::pair<std::string_view, Form> k_forms[] = {
        {"gcc", Form::gcc}, {"json", Form::json}, {"sarif", Form::sarif}};
    sink().form = std::ranges::find(k_forms, name, &std::pair<std::string_view, Form>::first)->second;
    if (sink().form != Form::gcc)
        keep_words_back();
}

/// Returns the diagnostics of an error in its order; if it has none, one finding with its message and no
/// place.
std::vector<Finding> findings_of(const Error& error) {
    std::vector<Finding> findings;
    for (const Diagnostic& diagnostic : error.diagnostics)
        findings.push_back(finding_of(diagnostic, rule_of(error.code)));
    if (findings.empty())
        findings.push_back({.diagnostic = {{}, Severity::error, error.message}, .rule = rule_of(error.code)});
    return findings;
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

void add_diagnostics_option(Command app) {
    for (Command command : app.subcommands())
        if (compiles_scenes(command))
            command
                .add_option(
                    "--diagnostics", [](const std::string& name) { choose(name); },
                    "Prints errors and warnings about the scene in a format for editors, on standard error")
                .type_name("gcc|json|sarif")
                .check(one_of({"gcc", "json", "sarif"}));
}

void place_diagnostics(std::string scene) {
    sink().scene = std::move(scene);
}

bool findings_are_diagnostics() {
    return sink().form != Form::people;
}

void say(const Finding& finding) {
    const std::scoped_lock lock(sink().mutex);
    switch (sink().form) {
    case Form::people: return say(to_string(finding.diagnostic));
    case Form::gcc: return say(to_gcc(finding.diagnostic));
    case Form::json: return say_to_programs(to_json_line(finding));
    case Form::sarif: sink().waiting.push_back(finding);
    }
}

void say(const Error& error) {
    if (sink().form == Form::people)
        return say(to_string(error));
    const bool of_scene = error.code == ErrorCode::load || error.code == ErrorCode::timed_out;
    for (Finding& finding : findings_of(error)) {
        if (of_scene && finding.diagnostic.where.file.empty())
            finding.diagnostic.where.file = sink().scene;
        say(finding);
    }
}

void finish_diagnostics(bool even_empty) {
    const std::scoped_lock lock(sink().mutex);
    if (sink().form == Form::sarif && (even_empty || !sink().waiting.empty()))
        say_to_programs(dump(sarif_log(std::exchange(sink().waiting, {})), 2));
}

} // namespace tidemark::host
