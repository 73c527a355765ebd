// Loads a Scene from a path, whatever its form.
#pragma once

#include "base/result.hpp"
#include "scene/load_options.hpp"
#include "scene/scene.hpp"

#include <filesystem>

namespace tidemark::scene {

/// Reads a scene: a bare `.glsl` or `.frag`, a scene folder, or a ShaderToy `.json`. Fails (ErrorCode::load)
/// with file and line. Pictures and other media are named, not opened.
Result<Scene> load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

} // namespace tidemark::scene
