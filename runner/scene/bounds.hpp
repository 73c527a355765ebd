// Limits the files that a scene may read. A scene may be a stranger's text: a path in it must not lead out of
// its folder unless the user allows that.
#pragma once

#include "base/result.hpp"
#include "scene/load_options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::scene {

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

} // namespace tidemark::scene
