// Splits a ShaderToy project into the files of a scene folder, and joins them again. Both are lossless: code
// byte for byte, and every field of the JSON in its place, even unknown ones.
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

/// Returns one file with the code of each pass and, last, `scene.json`: the project with `{"file": NAME}` in
/// place of each code. `file` is for messages.
Result<std::vector<ProjectFile>> split_project(std::string_view json, const std::string& file);

/// Restores the JSON that `split_project` took apart, from the folder's `scene.json`.
Result<std::string> join_project(const std::filesystem::path& folder, const Bounds& bounds);

/// Returns the knobs as GLSL constants with their present values, since ShaderToy has no user-defined
/// uniforms.
std::string knobs_as_constants(const Scene& scene);

/// Writes a scene as a project in the API's form: includes pasted, knobs as constants with their present
/// values, the channels that the passes mention. Adds to `warnings` the features that ShaderToy lacks; more
/// than four buffers are an error.
Result<std::string> make_project(const Scene& scene, std::vector<Diagnostic>& warnings);

} // namespace tidemark::scene
