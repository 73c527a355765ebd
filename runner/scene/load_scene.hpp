// Loading scenes: options, the limits of paths, folders, and any other form.
//
// The options with which a user opens a scene.
#pragma once

#include "base/error.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::scene {

/// Texts of files that are open in an editor and not saved, by weakly canonical path.
using UnsavedTexts = std::map<std::filesystem::path, std::string>;

struct LoadOptions {
    std::filesystem::path media; ///< --media: folder of ShaderToy's media files, by name
    bool allow_outside = false;  ///< --allow-outside: files may lie outside the scene's folder
    UnsavedTexts unsaved{};      ///< read in place of shader files on disk
};

// Limits the files that a scene may read. A scene may be a stranger's text: a path in it must not lead out of
// its folder unless the user allows that.

/// The scene's folder, the folders `textures` and `lib` next to it, which scenes share, and the shader
/// library.
class Bounds {
public:
    /// `folder` is the scene's. With `allow_outside` every file may be read. `unsaved` must outlive this
    /// object.
    Bounds(const std::filesystem::path& folder, bool allow_outside, const UnsavedTexts* unsaved = nullptr);

    /// Checks a path after following its symbolic links. The error (ErrorCode::load) says what to do; it has
    /// no source location.
    Result<void> check(const std::filesystem::path& file) const;
    /// The folder that `#include <tidemark/…>` reads.
    const std::filesystem::path& library() const { return library_; }
    /// Reads the text of a file within the bounds.
    Result<std::string> read_text(const std::filesystem::path& file) const;
    /// Returns the text that an editor has not saved to the file yet; nullptr if there is none.
    const std::string* unsaved(const std::filesystem::path& file) const;

private:
    std::string folder_; ///< as the user named it, for the message
    bool everything_;
    const UnsavedTexts* unsaved_;
    std::filesystem::path library_;
    std::vector<std::filesystem::path> roots_;
};

// Loads a scene folder as a Scene.

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

// Loads a Scene from a path, whatever its form.

/// Reads a scene: a bare `.glsl` or `.frag`, a scene folder, or a ShaderToy `.json`. Fails (ErrorCode::load)
/// with file and line. Pictures and other media are named, not opened.
Result<Scene> load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// Returns whether a path can be opened as a scene, or as a folder of scenes, by its name alone.
bool is_scene_file(const std::filesystem::path& path);

/// Returns the scenes that these paths name: files and scene folders themselves, of another folder its scenes
/// and the scene folders in it, sorted.
std::vector<std::filesystem::path> scenes_of(const std::vector<std::filesystem::path>& paths);

/// Returns whether the path is a folder of scenes and no scene itself.
bool is_folder_of_scenes(const std::filesystem::path& path);

} // namespace tidemark::scene
