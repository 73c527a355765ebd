// Diagnostics for other programs (--diagnostics): the finding and the output forms.
//
// A diagnostic for other programs, with the rule that found it and the end of the token that it is about.
#pragma once

#include "base/error.hpp"
#include "host/command_line.hpp"

#include <string>
#include <vector>

namespace tidemark::host {

/// The check that finds a diagnostic: loading a scene, or a probe.
struct Rule {
    std::string id;
    std::string about{}; ///< one sentence

    bool operator==(const Rule&) const = default;
};

struct Finding {
    Diagnostic diagnostic;
    Rule rule;
    int end_column = 0; ///< one past the last column, in bytes; 0: unknown
    std::string line{}; ///< the source line; empty if unknown
};

/// Returns the rule for reading and compiling a scene.
Rule scene_rule();

/// Adds the rule, and reads the diagnostic's file to find the line and the end of the token.
Finding finding_of(Diagnostic diagnostic, Rule rule = scene_rule());

// --diagnostics: the form in which problems of a scene go to standard error. The form is chosen once per run,
// when the command line is read; commands report through `say` and do not depend on it.

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

} // namespace tidemark::host
