// Loads ShaderToy's JSON as a Scene.
#pragma once

#include "base/result.hpp"
#include "scene/load_options.hpp"
#include "scene/scene.hpp"

#include <filesystem>

namespace tidemark::scene {

/// Reads a project in one `.json`. Messages give its lines as `x.json:Buffer A`, with line 1 the first line
/// of the pass. The texts are ShaderToy's: directives and includes in them are left to the driver.
Result<Scene> load_json_scene(const std::filesystem::path& path, const LoadOptions& options);

} // namespace tidemark::scene
