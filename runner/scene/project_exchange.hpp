// Finds ShaderToy projects in a saved web page: text in, the JSON texts of the projects out.
#pragma once

#include "base/error.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

/// Returns whether a text is HTML rather than JSON.
bool is_page(std::string_view text);

/// Returns the JSON objects in a page that have the key `renderpass`: from its scripts; if there are none,
/// from its visible text, as when a browser saves a page of JSON; if there are none, from attributes. Takes
/// time linear in the page.
std::vector<std::string> projects_in_page(std::string_view page);

// Extracts one project from a saved ShaderToy page or JSON, or from another program's output: a page or JSON
// in, JSON out. Makes no network requests.

/// Returns the six letters and digits of a project's address (https://www.shadertoy.com/view/XxXxXx, or one
/// with `embed` or of the API), or of an id alone; ErrorCode::usage if there are none.
Result<std::string> project_id(std::string_view address);

/// Returns JSON for `split_project`. `id` is the project to take from several; if it is empty, there must be
/// one, and JSON is returned unchanged. `file` is for messages.
Result<std::string> saved_project(std::string text, std::string_view id, const std::string& file);

// Splits a ShaderToy project into the files of a scene folder, and joins them again. Both are lossless: code
// byte for byte, and every field of the JSON in its place, even unknown ones.

struct ProjectFile {
    std::string name;
    std::string bytes;
};

/// Returns one file with the code of each pass and, last, `scene.json`: the project with `{"file": NAME}` in
/// place of each code. `file` is for messages.
Result<std::vector<ProjectFile>> split_project(std::string_view json, const std::string& file);

/// Restores the JSON that `split_project` took apart, from the folder's `scene.json`.
Result<std::string> join_project(const std::filesystem::path& folder, const Bounds& bounds);

/// Returns the knobs of directives as GLSL constants with their present values, since ShaderToy has no
/// user-defined uniforms. Plain knobs are declared in the text itself.
std::string knobs_as_constants(const Scene& scene);

/// Writes a scene as a project in the API's form: includes pasted, knobs as constants with their present
/// values, the channels that the passes mention. Adds to `warnings` the features that ShaderToy lacks; more
/// than four buffers are an error.
Result<std::string> make_project(const Scene& scene, std::vector<Diagnostic>& warnings);

} // namespace tidemark::scene
