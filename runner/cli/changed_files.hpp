// Settings and cures written into the files that a scene was read from: as a difference for people, then for
// good.
#pragma once

#include "base/result.hpp"
#include "cli/requests.hpp"
#include "glsl/cure/cure.hpp"
#include "scene/scene.hpp"
#include "scene/setting.hpp"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace tidemark::cli {

struct ChangedFile {
    std::string file;
    std::string before, after;
};

/// Loads a scene whose files are to be edited. A project's JSON is first imported into the folder beside it
/// that is named like it, and `request` then names that folder; fails (ErrorCode::write) if the folder holds
/// other files, or files that were edited since an import.
Result<scene::Scene> load_editable(SceneRequest& request);

/// Every file in which a knob or a definition would get another value.
Result<std::vector<ChangedFile>> with_settings(const scene::Scene& scene,
                                               const std::vector<scene::Setting>& settings);

/// The files of a scene with one cure after the other. Each file is read once: what is written meanwhile does
/// not move the words that cures stand around.
class CuredFiles {
public:
    /// Every file that the last of the cures changes; `before` is the file with those before it. Fails
    /// (ErrorCode::write) where its words are not there.
    Result<std::vector<ChangedFile>> with_last(std::span<const glsl::Cure> cures);

private:
    Result<std::string> text_of(const std::string& file);

    std::map<std::string, std::string> texts_{};
};

/// In the unified form. No line may have come or gone.
std::string difference(const ChangedFile& file);

/// Each of them whole or not at all; fails (ErrorCode::write) where one is not as it was read any more. The
/// difference is kept in a file beside it then.
Result<void> write_files(const std::vector<ChangedFile>& files);

} // namespace tidemark::cli
