// Where `import` has a ShaderToy project from: a file, or what a person's own program fetches. Nothing here
// asks a network.
#pragma once

#include "base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::cli {

struct ProjectSource {
    std::string project;   ///< a file; with `via` a project's ID or address
    std::string via;       ///< a file that holds it, or the words of a command that prints it
    double timeout = 60.0; ///< seconds that the command may take
};

struct FoundProject {
    std::string json;
    std::string from;                        ///< for messages
    std::filesystem::path name;              ///< what a folder of it is called
    std::vector<std::filesystem::path> read; ///< not to be written over
};

Result<FoundProject> find_project(const ProjectSource& source);

/// Imports the project of a JSON file into the folder beside it that is named like it, and returns the
/// folder. Prints what it writes. Fails (ErrorCode::write) if that folder holds other files, or files edited
/// since an import.
Result<std::filesystem::path> import_beside(const std::filesystem::path& json);

} // namespace tidemark::cli
