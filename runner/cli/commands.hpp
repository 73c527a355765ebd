// The sub-commands. Each registers itself on the application; the one that is called sets the exit code.
#pragma once

#include "base/error.hpp"
#include "host/command_line.hpp"

#include <functional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// The work of the chosen command, run after the whole command line has been checked; the value is the exit
/// code.
using Action = std::function<Result<int>()>;

/// Adds a sub-command to `app`. `chosen` is set when the command line calls it.
using AddCommand = void (*)(Command app, Action& chosen);

void add_capture(Command app, Action& chosen);
void add_inspect(Command app, Action& chosen);
void add_check(Command app, Action& chosen);
void add_import(Command app, Action& chosen);
void add_gather(Command app, Action& chosen);
void add_export(Command app, Action& chosen);
void add_new(Command app, Action& chosen);
void add_lsp(Command app, Action& chosen);
void add_bake(Command app, Action& chosen);
void add_compare(Command app, Action& chosen);
void add_study(Command app, Action& chosen);
void add_completion(Command app, Action& chosen);
void add_help(Command app, Action& chosen);
/// Returns the topics that `tidemark help` accepts, each once.
std::vector<std::string> help_topics();
void add_tune(Command app, Action& chosen);
void add_simplify(Command app, Action& chosen);
void add_trace(Command app, Action& chosen);
void add_view(Command app, Action& chosen);
void add_serve(Command app, Action& chosen);

/// Runs the whole program; returns the exit code.
int run(int argc, const char* const* argv);

} // namespace tidemark::cli
