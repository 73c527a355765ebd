// Writes settings and fixes into the files that a scene was read from: returns the new texts, prints them as
// a difference, and writes the files.
#pragma once

#include "base/error.hpp"
#include "host/requests.hpp"
#include "scene/knob.hpp"
#include "scene/scene.hpp"
#include "shader/source_edits.hpp"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace tidemark::cli {

struct ChangedFile {
    std::string file;
    std::string before, after;
};

/// Returns every file in which a knob or a definition gets another value.
Result<std::vector<ChangedFile>> with_settings(const scene::Scene& scene,
                                               const std::vector<scene::Setting>& settings);

/// The files of a scene to which fixes are applied one after another. Each file is read once, so that later
/// writes do not move the tokens at which fixes are placed.
class CuredFiles {
public:
    /// `unsaved`: texts of an editor, read in place of the files.
    explicit CuredFiles(const scene::UnsavedTexts& unsaved = {}) : unsaved_(unsaved) {}

    /// Returns every file that the last fix changes; `before` is the file with the earlier fixes. Fails
    /// (ErrorCode::write) if the file does not have the tokens that the fix replaces.
    Result<std::vector<ChangedFile>> with_last(std::span<const glsl::Cure> cures);

private:
    Result<std::string> text_of(const std::string& file);

    scene::UnsavedTexts unsaved_;
    std::map<std::string, std::string> texts_{};
};

/// Returns the difference in unified format. Both texts must have the same number of lines.
std::string difference(const ChangedFile& file);

/// Writes each file whole or not at all. Fails (ErrorCode::write) if one changed since it was read; the
/// difference is then kept in a new file next to it.
Result<void> write_files(const std::vector<ChangedFile>& files);

} // namespace tidemark::cli
