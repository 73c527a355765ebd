// --diagnostics: in which form what is wrong with a scene goes to standard error. One choice for the whole
// run, made when the command line is read; every command reports through `say` and need not know it.
#pragma once

#include "cli/command_line.hpp"
#include "cli/finding.hpp"

#include <string>

namespace tidemark::cli {

/// Adds --diagnostics to every sub-command that compiles a scene.
void add_diagnostics_option(Command app);

/// What is wrong with the scene and has no place of its own, as a file that cannot be read, is said of that.
void place_diagnostics(std::string scene);

/// Whether findings are asked for in a form that programs read: then they are not in the results, too.
bool findings_are_diagnostics();

void say(const Error& error);
void say(const Finding& finding);

/// Writes what waits for the end of the run: the SARIF log. `even_empty`: one that says that nothing was
/// found, too. To be called once in a process, before it ends.
void finish_diagnostics(bool even_empty);

} // namespace tidemark::cli
