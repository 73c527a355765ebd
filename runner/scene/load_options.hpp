// What the person who opens a scene allows it and gives it.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace tidemark::scene {

/// What editors hold of files and have not saved, by the files' weakly canonical paths.
using UnsavedTexts = std::map<std::filesystem::path, std::string>;

struct LoadOptions {
    std::filesystem::path media; ///< --media: where ShaderToy's media files are looked up by name
    bool allow_outside = false;  ///< --allow-outside: files may lie outside the scene's folder
    UnsavedTexts unsaved{};      ///< read instead of the files that hold shaders
};

} // namespace tidemark::scene
