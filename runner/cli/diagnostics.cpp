#include "cli/diagnostics.hpp"

#include "cli/command_line.hpp"
#include "cli/console.hpp"
#include "cli/json_dump.hpp"
#include "cli/limits.hpp"
#include "cli/sarif.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <mutex>
#include <utility>

namespace tidemark::cli {
namespace {

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

} // namespace

void add_diagnostics_option(Command app) {
    for (Command command : app.subcommands())
        if (compiles_scenes(command))
            command
                .add_option(
                    "--diagnostics", [](const std::string& name) { choose(name); },
                    "What is wrong with the scene in a form for editors, on standard error")
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

} // namespace tidemark::cli
