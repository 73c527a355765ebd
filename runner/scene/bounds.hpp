// Which files a scene may read. A scene is other people's text: a path in it must not lead out of its folder
// unless the person who runs it says so.
#pragma once

#include "base/result.hpp"
#include "scene/load_options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::scene {

/// The scene's folder, the folders `textures` and `lib` beside it, where scenes keep what they share, and the
/// shader library.
class Bounds {
public:
    /// `folder` is that of the scene; everything may be read when `allow_outside`. `unsaved` must live as
    /// long.
    Bounds(const std::filesystem::path& folder, bool allow_outside, const UnsavedTexts* unsaved = nullptr);

    /// Symbolic links are followed first. The error (ErrorCode::load) says what to do; it has no place yet.
    Result<void> check(const std::filesystem::path& file) const;
    /// What `#include <tidemark/…>` reads.
    const std::filesystem::path& library() const { return library_; }
    /// The text of a file within the bounds.
    Result<std::string> read_text(const std::filesystem::path& file) const;
    /// What an editor holds of a file; nullptr: it has what the file has.
    const std::string* unsaved(const std::filesystem::path& file) const;

private:
    std::string folder_; ///< as it was named, for the message
    bool everything_;
    const UnsavedTexts* unsaved_;
    std::filesystem::path library_;
    std::vector<std::filesystem::path> roots_;
};

} // namespace tidemark::scene
