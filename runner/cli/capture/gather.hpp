// Checks the output of a capture's shards against their common plan: whether every frame exists, is complete,
// and was drawn by one program on one kind of device, and whether this machine draws the same. Then makes a
// video of it on request.
#pragma once

#include "cli/capture/capture_plan.hpp"

#include <optional>
#include <string>

namespace tidemark::cli {

struct GatherOptions {
    std::filesystem::path folder;
    std::optional<std::string> video;
    std::string codec{};          ///< of the video; empty: the default of its file type
    int samples = 3;              ///< frames that are drawn again for comparison
    double tolerance = 2.0 / 255; ///< of a sample, if another device drew the frames
};

/// Returns exit code 1 if something is missing or different.
Result<int> gather(const GatherOptions& options);

} // namespace tidemark::cli
