// What the shards of a capture made, held against the plan that they share: is every frame there, whole, and
// drawn by one program on one kind of device; does this machine draw the same; then, if asked, a video of it.
#pragma once

#include "cli/capture/capture_plan.hpp"

#include <optional>
#include <string>

namespace tidemark::cli {

struct GatherOptions {
    std::filesystem::path folder;
    std::optional<std::string> video;
    std::string codec{};          ///< of it; empty: that of its name
    int samples = 3;              ///< frames that are drawn again
    double tolerance = 2.0 / 255; ///< of a sample, where another device draws
};

/// Exit code 1 where something is missing or another.
Result<int> gather(const GatherOptions& options);

} // namespace tidemark::cli
