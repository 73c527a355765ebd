// Settings written into the files that a scene was read from: as a difference for people, then for good.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"
#include "scene/setting.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

struct ChangedFile {
    std::string file;
    std::string before, after;
};

/// Every file in which a knob or a definition would get another value. Fails (ErrorCode::write) where that
/// is not a text of its own, as in a project's JSON.
Result<std::vector<ChangedFile>> with_settings(const scene::Scene& scene,
                                               const std::vector<scene::Setting>& settings);

/// In the unified form. No line may have come or gone.
std::string difference(const ChangedFile& file);

/// Each of them whole or not at all; fails (ErrorCode::write) where one is not as it was read any more.
Result<void> write_files(const std::vector<ChangedFile>& files);

} // namespace tidemark::cli
