// What a word of a command line may become: commands, options, and the values that we know. Prints nothing.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tidemark::cli {

/// What begins as the last of the `words` does, which may be empty; the words before it tell the command, the
/// option and the scene. Names of files are the shell's to complete.
std::vector<std::string> candidates(const CLI::App& app, const std::vector<std::string>& words);

} // namespace tidemark::cli
