// A diagnostic for other programs, with the rule that found it and the end of the token that it is about.
#pragma once

#include "base/error.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

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

/// Returns the diagnostics of an error in its order; if it has none, one finding with its message and no
/// place.
std::vector<Finding> findings_of(const Error& error);

} // namespace tidemark::cli
