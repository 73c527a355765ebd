// Lists the places at which a change can affect what a path leads to: its file and every link on the way.
// Reads the file system, watches nothing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::platform {

/// One name in one folder; an empty name means any entry. The folder's path has no links in it.
struct Waypoint {
    std::filesystem::path folder;
    std::string name;

    bool operator==(const Waypoint&) const = default;
};

/// Returns the links on the way to `file`, in order, then the file itself. For a path that ends with a slash,
/// which is a folder, the last waypoint is that folder with an empty name. If a part is missing, the last
/// waypoint is the first missing name, so its folder exists.
std::vector<Waypoint> trail_of(const std::filesystem::path& file);

} // namespace tidemark::platform
