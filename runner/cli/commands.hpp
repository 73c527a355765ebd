// The sub-commands. Each registers itself on the application; the one that is called sets the exit code.
#pragma once

#include "base/error.hpp"
#include "host/command_line.hpp"

#include <functional>
#include <string>
#include <vector>

namespace tidemark::scene {
struct Scene;
}

namespace tidemark::host {
struct SceneRequest;
}

namespace tidemark::cli {

/// The work of the chosen command, run after the whole command line has been checked; the value is the exit
/// code.
using Action = std::function<Result<int>()>;

/// Adds a sub-command to `app`. `chosen` is set when the command line calls it.
using AddCommand = void (*)(host::Command app, Action& chosen);

void add_capture(host::Command app, Action& chosen);
void add_inspect(host::Command app, Action& chosen);
void add_check(host::Command app, Action& chosen);
void add_import(host::Command app, Action& chosen);
void add_gather(host::Command app, Action& chosen);
void add_export(host::Command app, Action& chosen);
void add_new(host::Command app, Action& chosen);
void add_lsp(host::Command app, Action& chosen);
void add_bake(host::Command app, Action& chosen);
void add_compare(host::Command app, Action& chosen);
void add_study(host::Command app, Action& chosen);
void add_completion(host::Command app, Action& chosen);
void add_help(host::Command app, Action& chosen);
/// Returns the topics that `tidemark help` accepts, each once.
std::vector<std::string> help_topics();
void add_tune(host::Command app, Action& chosen);
void add_simplify(host::Command app, Action& chosen);
void add_trace(host::Command app, Action& chosen);
void add_view(host::Command app, Action& chosen);
void add_serve(host::Command app, Action& chosen);

/// Loads a scene whose files are to be edited (import.cpp). A project's JSON is first imported into the
/// folder beside it that is named like it, and `request` then names that folder; fails (ErrorCode::write) if
/// the folder holds other files, or files that were edited since an import.
Result<scene::Scene> load_editable(host::SceneRequest& request);

/// Runs the whole program; returns the exit code.
int run(int argc, const char* const* argv);

} // namespace tidemark::cli
