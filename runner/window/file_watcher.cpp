#include "window/file_watcher.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <uv.h>

#include <algorithm>
#include <deque>
#include <future>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace tidemark::window {
namespace fs = std::filesystem;
namespace {

/// The kernel's limit: a path with more links is taken to be circular.
constexpr int k_most_links = 40;

void prepend(std::deque<fs::path>& names, const fs::path& path) {
    names.insert(names.begin(), path.begin(), path.end());
}

/// A folder's device and inode: a folder that was deleted and made again is another one.
struct Identity {
    dev_t device = 0;
    ino_t number = 0;
    bool operator==(const Identity&) const = default;
};

Identity identity_of(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        return {};
    return {status.st_dev, status.st_ino};
}

/// Returns whether the file exists and has not just been emptied to be rewritten.
bool looks_saved(const fs::path& file) {
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 && (!S_ISREG(status.st_mode) || status.st_size > 0);
}

/// One watched folder; lives as long as libuv's handle.
struct Folder {
    uv_fs_event_t handle{};
    fs::path path;
    Identity identity;
};

/// Keeps the folder alive until libuv frees its handle, in a later iteration of its loop.
void close_folder(std::unique_ptr<Folder> folder) {
    uv_close(reinterpret_cast<uv_handle_t*>(&folder.release()->handle),
             [](uv_handle_t* handle) { std::unique_ptr<Folder>(static_cast<Folder*>(handle->data)); });
}

Error cannot_watch(std::string_view what, int uv_error) {
    const std::string_view remedy = uv_error == UV_ENOSPC ? " (raise fs.inotify.max_user_watches)"
                                    : uv_error == UV_EMFILE
                                        ? " (raise `ulimit -n` or fs.inotify.max_user_instances)"
                                        : "";
    return {ErrorCode::load,
            fmt::format("cannot watch {} for changes: {}{}", what, uv_strerror(uv_error), remedy),
            {}};
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

/// libuv's loop and its thread. Once the thread runs, only it accesses the members without a lock:
/// `on_thread` passes work to it, `ready_` returns results.
class FileWatcher::Loop {
public:
    explicit Loop(std::function<void()> wake) : wake_(std::move(wake)) {}
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;
    ~Loop() {
        if (thread_.joinable()) {
            (void)on_thread(Task([this]() -> Result<void> {
                uv_stop(&loop_);
                return {};
            }));
            thread_.join();
        }
        if (!has_loop_)
            return;
        for (auto& [path, folder] : folders_)
            close_folder(std::move(folder));
        for (uv_handle_t* handle :
             {reinterpret_cast<uv_handle_t*>(&timer_), reinterpret_cast<uv_handle_t*>(&task_signal_)})
            if (uv_handle_get_type(handle) != UV_UNKNOWN_HANDLE)
                uv_close(handle, nullptr);
        uv_run(&loop_, UV_RUN_DEFAULT);
        uv_loop_close(&loop_);
    }

    Result<void> start() {
        int error = uv_loop_init(&loop_);
        has_loop_ = error == 0;
        if (!error) {
            loop_.data = this;
            uv_timer_init(&loop_, &timer_);
            error = uv_async_init(&loop_, &task_signal_, [](uv_async_t* signal) {
                static_cast<Loop*>(signal->loop->data)->do_tasks();
            });
        }
        if (error)
            return fail(cannot_watch("files", error));
        try {
            thread_ = std::thread([this] { uv_run(&loop_, UV_RUN_DEFAULT); });
        } catch (const std::system_error& no_thread) {
            return fail(ErrorCode::load, fmt::format("cannot watch files for changes: {}", no_thread.what()));
        }
        return {};
    }

    Result<void> watch(std::vector<fs::path> files) {
        std::ranges::sort(files);
        files.erase(std::unique(files.begin(), files.end()), files.end());
        if (files == asked_for_)
            return {};
        asked_for_ = std::move(files);
        Result<void> watched = on_thread(Task([this] { return replace_files(asked_for_); }));
        if (!watched)
            asked_for_.clear(); // so that the next call tries again
        return watched;
    }

    std::vector<FileWatcher::Change> changed() {
        const std::lock_guard lock(mutex_);
        std::vector<Change> changes;
        for (const auto& [file, at] : ready_)
            changes.push_back({file, at});
        ready_.clear();
        return changes;
    }

private:
    using Task = std::packaged_task<Result<void>()>;

    struct Tracked {
        fs::path absolute;
        std::vector<Waypoint> trail{};
        bool pending = false;
        std::chrono::steady_clock::time_point last_event{};
    };

    Result<void> on_thread(Task task) {
        std::future<Result<void>> done = task.get_future();
        {
            const std::lock_guard lock(mutex_);
            tasks_.push_back(std::move(task));
        }
        uv_async_send(&task_signal_);
        return done.get();
    }

    void do_tasks() {
        std::vector<Task> tasks;
        {
            const std::lock_guard lock(mutex_);
            tasks.swap(tasks_);
        }
        for (Task& task : tasks)
            task();
    }

    Result<void> replace_files(const std::vector<fs::path>& files) {
        std::map<fs::path, Tracked> replaced;
        for (const fs::path& file : files) {
            std::error_code ignored;
            const auto known = files_.find(file);
            replaced[file] = known != files_.end() ? known->second : Tracked{fs::absolute(file, ignored)};
        }
        files_ = std::move(replaced);
        {
            const std::lock_guard lock(mutex_);
            std::erase_if(ready_, [&](const auto& change) { return !files_.contains(change.first); });
        }
        return follow_trails();
    }

    /// Watches the folders on the files' current paths, and no others.
    Result<void> follow_trails() {
        // Repeats after each new watch, since a folder may come or go between the search and the watch. The
        // bound is for a file system that never comes to rest.
        constexpr int k_most_rounds = 8;
        for (int round = 0; round < k_most_rounds; ++round) {
            const std::set<fs::path> wanted = find_trails();
            drop_folders_not_in(wanted);
            Result<void> result;
            bool added = false;
            for (const fs::path& path : wanted) {
                if (folders_.contains(path))
                    continue;
                const int error = add_folder(path);
                added |= error == 0 || error == UV_ENOENT;
                if (error && result)
                    result = fail(cannot_watch(fmt::format("'{}'", path.string()), error));
            }
            if (!added)
                return result;
        }
        return {};
    }

    std::set<fs::path> find_trails() {
        std::set<fs::path> wanted;
        for (auto& [spelling, file] : files_) {
            file.trail = trail_of(file.absolute);
            for (const Waypoint& waypoint : file.trail)
                wanted.insert(waypoint.folder);
        }
        return wanted;
    }

    void drop_folders_not_in(const std::set<fs::path>& wanted) {
        for (auto entry = folders_.begin(); entry != folders_.end();) {
            const bool stays =
                wanted.contains(entry->first) && entry->second->identity == identity_of(entry->first);
            if (stays) {
                ++entry;
                continue;
            }
            close_folder(std::move(entry->second));
            entry = folders_.erase(entry);
        }
    }

    int add_folder(const fs::path& path) {
        auto folder = std::make_unique<Folder>();
        folder->path = path;
        // Before the watch: if the folder is replaced in between, the next search finds another identity.
        folder->identity = identity_of(path);
        uv_fs_event_init(&loop_, &folder->handle);
        folder->handle.data = folder.get();
        const auto report = [](uv_fs_event_t* handle, const char* name, int events, int) {
            static_cast<Loop*>(handle->loop->data)
                ->on_event(*static_cast<Folder*>(handle->data), name, events);
        };
        const int error = uv_fs_event_start(&folder->handle, report, path.c_str(), 0);
        if (error)
            close_folder(std::move(folder));
        else
            folders_[path] = std::move(folder);
        return error;
    }

    void on_event(Folder& folder, const char* name, int events) {
        // libuv reports the folder's own name when it is deleted or moved: its watch is useless then.
        const bool is_folder = !name || ((events & UV_RENAME) && folder.path.filename() == name);
        bool leads_elsewhere = is_folder;
        for (auto& [spelling, file] : files_)
            for (const Waypoint& waypoint : file.trail)
                if (waypoint.folder == folder.path && (is_folder || waypoint.name == name)) {
                    touch(file);
                    leads_elsewhere |= (events & UV_RENAME) != 0;
                } else if (waypoint.folder == folder.path && waypoint.name.empty() && (events & UV_RENAME)) {
                    touch(file);
                }
        if (is_folder)
            folder.identity = {};
        if (leads_elsewhere)
            (void)follow_trails(); // a folder that cannot be watched is tried again at the next event
    }

    void touch(Tracked& file) {
        file.pending = true;
        file.last_event = std::chrono::steady_clock::now();
        const auto quiet = uint64_t(k_quiet.count());
        if (!uv_is_active(reinterpret_cast<uv_handle_t*>(&timer_)) || uv_timer_get_due_in(&timer_) > quiet)
            settle_in(quiet);
    }

    void settle_in(uint64_t milliseconds) {
        const auto ring = [](uv_timer_t* timer) { static_cast<Loop*>(timer->loop->data)->settle(); };
        uv_timer_start(&timer_, ring, milliseconds, 0);
    }

    /// Reports the files that have been quiet for long enough; sets the timer again if others have not.
    void settle() {
        // A folder that is deleted while another program has it open sends no event: it must be looked at.
        (void)follow_trails();
        const auto now = std::chrono::steady_clock::now();
        const auto quiet = uint64_t(k_quiet.count());
        uint64_t next = UINT64_MAX;
        std::map<fs::path, std::chrono::steady_clock::time_point> settled;
        for (auto& [spelling, file] : files_) {
            if (!file.pending)
                continue;
            const auto age =
                uint64_t(std::chrono::ceil<std::chrono::milliseconds>(now - file.last_event).count());
            const uint64_t needed = looks_saved(file.absolute) ? quiet : uint64_t(k_patience.count());
            if (age >= needed) {
                file.pending = false;
                settled.emplace(spelling, file.last_event);
            } else {
                next = std::min(next, age < quiet ? quiet - age : quiet);
            }
        }
        if (next != UINT64_MAX)
            settle_in(next);
        if (settled.empty())
            return;
        {
            const std::lock_guard lock(mutex_);
            for (const auto& [file, at] : settled)
                ready_[file] = at;
        }
        if (wake_)
            wake_();
    }

    const std::function<void()> wake_;
    std::vector<fs::path> asked_for_; ///< on the caller's thread

    bool has_loop_ = false;
    uv_loop_t loop_{};
    uv_async_t task_signal_{};
    uv_timer_t timer_{};
    std::map<fs::path, Tracked> files_; ///< by the spelling that the caller used
    std::map<fs::path, std::unique_ptr<Folder>> folders_;

    std::mutex mutex_; ///< guards the next two
    std::vector<Task> tasks_;
    std::map<fs::path, std::chrono::steady_clock::time_point> ready_; ///< with the time of the change

    std::thread thread_;
};

FileWatcher::FileWatcher(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {}
FileWatcher::FileWatcher(FileWatcher&&) noexcept = default;
FileWatcher& FileWatcher::operator=(FileWatcher&&) noexcept = default;
FileWatcher::~FileWatcher() = default;

Result<FileWatcher> FileWatcher::create(std::function<void()> wake) {
    auto loop = std::make_unique<Loop>(std::move(wake));
    if (Result<void> started = loop->start(); !started)
        return fail(started.error());
    return FileWatcher(std::move(loop));
}

Result<void> FileWatcher::watch(std::span<const fs::path> files) {
    return loop_->watch({files.begin(), files.end()});
}

std::vector<FileWatcher::Change> FileWatcher::changed() {
    return loop_->changed();
}

} // namespace tidemark::window
