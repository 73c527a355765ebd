// What the person who opens a scene allows it and gives it.
#pragma once

#include <filesystem>

namespace tidemark::scene {

struct LoadOptions {
    std::filesystem::path media; ///< --media: where ShaderToy's media files are looked up by name
    bool allow_outside = false;  ///< --allow-outside: files may lie outside the scene's folder
};

} // namespace tidemark::scene
