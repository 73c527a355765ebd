// The manual pages next to the code, embedded when the program is built (runner/CMakeLists.txt).
#pragma once

#include <span>
#include <string_view>

namespace tidemark::cli {

/// Returns the Markdown of each page, the command line's pages first.
std::span<const std::string_view> help_pages();

// The scenes that `new` writes, as texts: the files of scenes/, embedded in the program
// (runner/CMakeLists.txt). A new scene needs its files, their names there, and a row in the table of
// scenes in the .in file beside this one.

struct TemplateFile {
    std::string_view name; ///< in the scene's folder; empty: the scene is this file
    std::string_view text;
};

struct SceneTemplate {
    std::string_view flag;    ///< for example --orbit; empty: the default scene
    std::string_view meaning; ///< of that flag, for --help
    std::span<const TemplateFile> files;

    bool is_folder() const { return !files.front().name.empty(); }
};

std::span<const SceneTemplate> scene_templates();

} // namespace tidemark::cli
