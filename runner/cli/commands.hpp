// The sub-commands. Each registers itself on the application and, when it was the one called, puts its
// outcome into the exit code.
#pragma once

#include "base/result.hpp"

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tidemark::cli {

/// What a command that was called does once the whole line is known to be good; the value is the exit code.
using Action = std::function<Result<int>()>;

/// Adds a sub-command to `app`. `chosen` is set when the line calls it.
using AddCommand = void (*)(CLI::App& app, Action& chosen);

void add_capture(CLI::App& app, Action& chosen);
void add_inspect(CLI::App& app, Action& chosen);
void add_check(CLI::App& app, Action& chosen);
void add_import(CLI::App& app, Action& chosen);
void add_gather(CLI::App& app, Action& chosen);
void add_export(CLI::App& app, Action& chosen);
void add_new(CLI::App& app, Action& chosen);
void add_lsp(CLI::App& app, Action& chosen);
void add_bake(CLI::App& app, Action& chosen);
void add_compare(CLI::App& app, Action& chosen);
void add_study(CLI::App& app, Action& chosen);
void add_completion(CLI::App& app, Action& chosen);
void add_help(CLI::App& app, Action& chosen);
/// What it takes, each once.
std::vector<std::string> help_topics();
void add_tune(CLI::App& app, Action& chosen);
void add_simplify(CLI::App& app, Action& chosen);
void add_trace(CLI::App& app, Action& chosen);
void add_view(CLI::App& app, Action& chosen);
void add_serve(CLI::App& app, Action& chosen);

/// The whole program.
int run(int argc, const char* const* argv);

} // namespace tidemark::cli
