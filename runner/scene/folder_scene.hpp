// Loads a scene folder as a Scene.
#pragma once

#include "base/result.hpp"
#include "scene/load_options.hpp"
#include "scene/pass_names.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <utility>
#include <vector>

namespace tidemark::scene {

/// The project file of a scene folder; it lists the passes.
inline constexpr const char* k_project_file = "scene.json";

/// Reads `image.glsl`, `buffer_a.glsl` … `buffer_d.glsl`, `common.glsl`, `cube_a.glsl`, `sound.glsl`, under
/// any name that parse_pass_name() accepts. If there is also a `scene.json`, a ShaderToy project whose code
/// is in these files, it decides which passes there are and what they read.
Result<Scene> load_folder_scene(const std::filesystem::path& folder, const LoadOptions& options);

/// Returns the files that make a folder a scene, by name alone: passes and the project file. Sorted; empty if
/// the folder does not exist.
std::vector<std::filesystem::path> scene_files_in(const std::filesystem::path& folder);

/// Returns the files whose names are passes, in the order Common, A to D, Cube A, Image, Sound. Fails if two
/// files are the same pass.
Result<std::vector<std::pair<PassName, std::filesystem::path>>>
pass_files(const std::filesystem::path& folder);

} // namespace tidemark::scene
