// Completes the last argument of a command line: commands, options, and known values. Prints nothing.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tidemark::cli {

/// Returns what starts with the last of `words`, which may be empty; the arguments before it determine the
/// command, the option and the scene. The shell completes file names itself.
std::vector<std::string> candidates(const CLI::App& app, const std::vector<std::string>& words);

} // namespace tidemark::cli
