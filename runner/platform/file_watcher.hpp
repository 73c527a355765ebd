// Tells when files were saved. In come the files that a scene read, out go those that have changed and
// are quiet again. Sees names and times only: it does not read the files, and does not know what for.
#pragma once

#include "base/result.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace tidemark::platform {

/// Watches the *folders* of its files, so a file may be overwritten, replaced by renaming another one
/// over it, be gone for a moment, be a symbolic link or lie behind one, and its folder may be deleted and
/// made again. (Not seen: a folder further up that is renamed away, and changes that another machine
/// makes on a network file system.) A thread of its own sleeps until something happens.
class FileWatcher {
public:
    /// A file, in the spelling `watch` was given, and when it was last written to or got its name: not its
    /// own time, which one that is moved into place brings along.
    struct Change {
        std::filesystem::path file;
        std::chrono::steady_clock::time_point at;
    };

    /// How long a file must have been left alone before it is reported: the time a save takes.
    static constexpr std::chrono::milliseconds k_quiet{6};
    /// How long a file that is missing or empty may stay so before it is reported all the same. In the
    /// middle of a save it is one or the other.
    static constexpr std::chrono::milliseconds k_patience{500};

    /// `wake` is called on the watcher's thread when `changed` has something new to say; it must be quick,
    /// and must not call the watcher. Fails (ErrorCode::load) when the system has no more watchers to give.
    static Result<FileWatcher> create(std::function<void()> wake = {});
    FileWatcher(FileWatcher&&) noexcept;
    FileWatcher& operator=(FileWatcher&&) noexcept;
    ~FileWatcher();

    /// Replaces the files; they need not exist. When it returns, every later change is seen: call it
    /// before the files are used for something slow, such as compiling. A path with a slash at its end is a
    /// folder: it changes when something in it gets a name or loses one. What is known of files that stay
    /// in the set is kept, and an unchanged set costs nothing. Relative paths are relative to the current
    /// folder now. Fails (ErrorCode::load) naming a folder that cannot be watched; the others are.
    Result<void> watch(std::span<const std::filesystem::path> files);

    /// The files that were saved since the last call, sorted. Never waits.
    std::vector<Change> changed();

private:
    class Loop;
    explicit FileWatcher(std::unique_ptr<Loop> loop);

    std::unique_ptr<Loop> loop_;
};

} // namespace tidemark::platform
