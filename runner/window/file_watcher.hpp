// Watches files for changes by the user's editor: the places to watch, and the watcher.
//
// Lists the places at which a change can affect what a path leads to: its file and every link on the way.
// Reads the file system, watches nothing.
#pragma once

#include "base/error.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tidemark::window {

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

// Reports when files were saved: takes the files that a scene read, returns those that have changed and are
// quiet again. Looks at names and times only; does not read the files.

/// Watches the *folders* of its files, so a file may be overwritten, replaced by renaming another one over
/// it, missing for a moment, or reached through symbolic links, and its folder may be deleted and made again.
/// Not detected: a renamed folder further up, and changes by another machine on a network file system. A
/// thread of its own sleeps until something happens.
class FileWatcher {
public:
    /// A file, spelled as in `watch`, and the time of the event in which it was written to or got its name.
    /// This is not the file's own time, which a file that is moved into place keeps from before.
    struct Change {
        std::filesystem::path file;
        std::chrono::steady_clock::time_point at;
    };

    /// Time without changes before a file is reported; a save takes less.
    static constexpr std::chrono::milliseconds k_quiet{6};
    /// Time after which a file that is missing or empty is reported all the same. It may be either in the
    /// middle of a save.
    static constexpr std::chrono::milliseconds k_patience{500};

    /// `wake` is called on the watcher's thread when `changed` has something new to return; it must be quick
    /// and must not call the watcher. Fails (ErrorCode::load) if the system has no more watchers.
    static Result<FileWatcher> create(std::function<void()> wake = {});
    FileWatcher(FileWatcher&&) noexcept;
    FileWatcher& operator=(FileWatcher&&) noexcept;
    ~FileWatcher();

    /// Replaces the set of files; they need not exist. Once this returns, every later change is detected:
    /// call it before anything slow, such as compiling. A path that ends with a slash is a folder, which
    /// changes when an entry in it is added, removed or renamed. Files that stay in the set keep their state,
    /// and an unchanged set costs nothing. Relative paths are resolved now. Fails (ErrorCode::load), naming a
    /// folder that cannot be watched; the others are watched.
    Result<void> watch(std::span<const std::filesystem::path> files);

    /// Returns the files saved since the last call, sorted. Never waits.
    std::vector<Change> changed();

private:
    class Loop;
    explicit FileWatcher(std::unique_ptr<Loop> loop);

    std::unique_ptr<Loop> loop_;
};

} // namespace tidemark::window
