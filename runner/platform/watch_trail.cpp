#include "platform/watch_trail.hpp"

#include <deque>

namespace tidemark::platform {
namespace fs = std::filesystem;
namespace {

/// The kernel's limit: a path with more links is taken to be circular.
constexpr int k_most_links = 40;

void prepend(std::deque<fs::path>& names, const fs::path& path) {
    names.insert(names.begin(), path.begin(), path.end());
}

} // namespace

std::vector<Waypoint> trail_of(const fs::path& file) {
    std::error_code ignored;
    std::deque<fs::path> names;
    prepend(names, fs::absolute(file, ignored));
    std::vector<Waypoint> trail;
    fs::path folder = "/";
    for (int links = 0; !names.empty();) {
        const fs::path name = names.front();
        names.pop_front();
        if (name.empty() && names.empty()) { // a slash at the end
            trail.push_back({folder, ""});
            return trail;
        }
        if (name.empty() || name == "." || name == "/")
            continue;
        if (name == "..") {
            folder = folder.parent_path();
            continue;
        }
        const fs::path entry = folder / name;
        const fs::file_type type = fs::symlink_status(entry, ignored).type();
        const bool is_link = type == fs::file_type::symlink;
        const bool leads_on = is_link || type == fs::file_type::directory;
        if (is_link || !leads_on || names.empty())
            trail.push_back({folder, name.string()});
        if (!leads_on)
            return trail;
        if (!is_link) {
            folder = entry;
            continue;
        }
        if (++links > k_most_links)
            return trail;
        const fs::path target = fs::read_symlink(entry, ignored);
        if (target.is_absolute())
            folder = "/";
        prepend(names, target);
    }
    return trail;
}

} // namespace tidemark::platform
