// One diagnostic as other programs take it: with what found it, and with the end of the word it is about.
#pragma once

#include "base/error.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// What finds things: loading a scene, a probe.
struct Rule {
    std::string id;
    std::string about{}; ///< a sentence

    bool operator==(const Rule&) const = default;
};

struct Finding {
    Diagnostic diagnostic;
    Rule rule;
    int end_column = 0; ///< one past the last, in bytes; 0: not known
    std::string line{}; ///< as its author has it; empty where that is not known
};

/// Of a scene that is read and compiled.
Rule scene_rule();

/// Reads the file that it is about for the end.
Finding finding_of(Diagnostic diagnostic, Rule rule = scene_rule());

/// The diagnostics of an error, in its order; of one that has none its message, which has no place.
std::vector<Finding> findings_of(const Error& error);

} // namespace tidemark::cli
