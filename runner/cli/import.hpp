// The source of a ShaderToy project for `import`: a file, or the output of the user's own program. Makes no
// network requests.
#pragma once

#include "base/error.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::cli {

struct ProjectSource {
    std::string project;   ///< a file; with `via` a project's ID or URL
    std::string via;       ///< a file that holds it, or a command line that prints it
    double timeout = 60.0; ///< timeout of the command in seconds
};

struct FoundProject {
    std::string json;
    std::string from;                        ///< for messages
    std::filesystem::path name;              ///< default name of the output folder
    std::vector<std::filesystem::path> read; ///< files that must not be overwritten
};

Result<FoundProject> find_project(const ProjectSource& source);

/// Imports the project of a JSON file into the folder beside it that is named like it, and returns the
/// folder. Prints what it writes. Fails (ErrorCode::write) if that folder holds other files, or files edited
/// since an import.
Result<std::filesystem::path> import_beside(const std::filesystem::path& json);

} // namespace tidemark::cli
