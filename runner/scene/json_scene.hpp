// From ShaderToy's JSON to a Scene.
#pragma once

#include "base/result.hpp"
#include "scene/load_options.hpp"
#include "scene/scene.hpp"

#include <filesystem>

namespace tidemark::scene {

/// Reads a project in one `.json`. Messages place its lines at `x.json:Buffer A`, line 1 being the first line
/// of the pass. Its texts are ShaderToy's own: directives and includes in them are the driver's business.
Result<Scene> load_json_scene(const std::filesystem::path& path, const LoadOptions& options);

} // namespace tidemark::scene
