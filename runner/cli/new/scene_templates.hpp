// The scenes that `new` begins with, as texts: they are the files of scenes/, and lie in the program
// (runner/CMakeLists.txt). Another one is its files, their names there, and a row in the table beside this.
#pragma once

#include <span>
#include <string_view>

namespace tidemark::cli {

struct TemplateFile {
    std::string_view name; ///< in the scene's folder; empty: the scene is this file
    std::string_view text;
};

struct SceneTemplate {
    std::string_view flag;    ///< --orbit; empty: what `new` makes where nothing is said
    std::string_view meaning; ///< of that flag, for --help
    std::span<const TemplateFile> files;

    bool is_folder() const { return !files.front().name.empty(); }
};

std::span<const SceneTemplate> scene_templates();

} // namespace tidemark::cli
