// A ShaderToy project taken apart into the files of a scene folder, and put together again. Nothing is lost
// either way: code byte for byte, and every field of the JSON in its place, whether we know it or not.
#pragma once

#include "base/result.hpp"
#include "scene/bounds.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

struct ProjectFile {
    std::string name;
    std::string bytes;
};

/// The code of every pass in a file of its own, and last `scene.json`: the project with `{"file": NAME}` in
/// the place of each code. `file` is for the messages.
Result<std::vector<ProjectFile>> split_project(std::string_view json, const std::string& file);

/// The JSON that `split_project` took apart, from the folder's `scene.json`.
Result<std::string> join_project(const std::filesystem::path& folder, const Bounds& bounds);

/// Knobs with their present values, as GLSL: ShaderToy has no uniforms of one's own.
std::string knobs_as_constants(const Scene& scene);

/// A scene that never was a project, as one in the form of the API: includes pasted, knobs as constants of
/// their present values, the channels that the passes mention. What ShaderToy cannot have is added to
/// `warnings`; more buffers than it has are an error.
Result<std::string> make_project(const Scene& scene, std::vector<Diagnostic>& warnings);

} // namespace tidemark::scene
