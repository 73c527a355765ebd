// From a scene folder to a Scene.
#pragma once

#include "base/result.hpp"
#include "scene/load_options.hpp"
#include "scene/pass_names.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <utility>
#include <vector>

namespace tidemark::scene {

/// What a folder without a project says which passes there are.
inline constexpr const char* k_project_file = "scene.json";

/// Reads `image.glsl`, `buffer_a.glsl` … `buffer_d.glsl`, `common.glsl`, `cube_a.glsl`, `sound.glsl`, under
/// whatever name parse_pass_name() takes for them. With a `scene.json` beside them, which is a ShaderToy
/// project whose code stands in these files, that says which passes there are and what they read.
Result<Scene> load_folder_scene(const std::filesystem::path& folder, const LoadOptions& options);

/// The files of a folder that make it a scene, by their names alone: passes and the project. Sorted; none
/// where there is no such folder.
std::vector<std::filesystem::path> scene_files_in(const std::filesystem::path& folder);

/// The files of a folder that are passes by their names, in the order Common, A to D, Cube A, Image, Sound.
/// Two files for one pass are an error.
Result<std::vector<std::pair<PassName, std::filesystem::path>>>
pass_files(const std::filesystem::path& folder);

} // namespace tidemark::scene
