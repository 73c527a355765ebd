// The options with which a user opens a scene.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace tidemark::scene {

/// Texts of files that are open in an editor and not saved, by weakly canonical path.
using UnsavedTexts = std::map<std::filesystem::path, std::string>;

struct LoadOptions {
    std::filesystem::path media; ///< --media: folder of ShaderToy's media files, by name
    bool allow_outside = false;  ///< --allow-outside: files may lie outside the scene's folder
    UnsavedTexts unsaved{};      ///< read in place of shader files on disk
};

} // namespace tidemark::scene
