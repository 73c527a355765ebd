// --diagnostics: the form in which problems of a scene go to standard error. The form is chosen once per run,
// when the command line is read; commands report through `say` and do not depend on it.
#pragma once

#include "cli/command_line.hpp"
#include "cli/finding.hpp"

#include <string>

namespace tidemark::cli {

/// Adds --diagnostics to every sub-command that compiles a scene.
void add_diagnostics_option(Command app);

/// Sets the file to which findings about the scene without a place of their own are assigned, for example
/// that it cannot be read.
void place_diagnostics(std::string scene);

/// Returns true if findings go to standard error in a form for programs; they are then left out of the
/// results.
bool findings_are_diagnostics();

void say(const Error& error);
void say(const Finding& finding);

/// Writes the SARIF log, which waits for the end of the run. `even_empty`: write it even if nothing was
/// found. Call it once per process, before it ends.
void finish_diagnostics(bool even_empty);

} // namespace tidemark::cli
