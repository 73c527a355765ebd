// The source of a ShaderToy project for `import`: a file, or the output of the user's own program. Makes no
// network requests.
#pragma once

#include "base/result.hpp"

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

} // namespace tidemark::cli
