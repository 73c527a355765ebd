// Where something may happen that changes what a path leads to: its file, and every link on the way.
// Reads the file system, watches nothing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::platform {

/// One name in one folder; empty: whichever. The folder's path holds no links.
struct Waypoint {
    std::filesystem::path folder;
    std::string name;

    bool operator==(const Waypoint&) const = default;
};

/// The links that `file` passes through, in order, then the file itself; of a path with a slash at its end,
/// which is a folder, no name in that folder. Where something is missing the
/// last waypoint is the first missing name, so its folder is one that exists.
std::vector<Waypoint> trail_of(const std::filesystem::path& file);

} // namespace tidemark::platform
