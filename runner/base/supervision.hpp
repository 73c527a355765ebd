// Shared state for the end of a process: files to remove, programs to kill, the current driver call.
//
// Cleans up after a process that ends early, by a signal or because a driver hangs: removes files under
// construction and kills started programs.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tidemark {

/// Registers one file or child while it lives. Beyond 128 at once, further ones are not registered.
class Leftover {
public:
    Leftover() = default;
    /// Registers a file; to be called before the file is made.
    static Leftover file(const std::filesystem::path& path);
    /// Registers the leader of a process group.
    static Leftover child(pid_t process);

    Leftover(Leftover&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}
    Leftover& operator=(Leftover&& other) noexcept {
        std::swap(slot_, other.slot_);
        return *this;
    }
    ~Leftover() { forget(); }
    void forget();

private:
    int slot_ = -1;
};

/// Cleans up and exits without running destructors, unlike `exit`.
[[noreturn]] void exit_at_once(int code);

/// Removes the files registered by forked processes that have died, by a crash or SIGKILL, without cleaning
/// up. Does not end their children.
void clear_leftovers_of_the_dead();

/// Installs handlers of SIGHUP, SIGINT, SIGQUIT and SIGTERM that clean up and end the process with 130,
/// SIGQUIT with a core. A signal that is ignored or has a handler stays as it is. To be called before the
/// first fork.
void clear_leftovers_on_signals();

// The current driver call, kept in shared memory so that the supervisor can report it after a crash. Takes
// and returns texts; makes no decisions.

/// A memory page shared with the processes forked after it was made. It is never freed.
class DoingPage {
public:
    /// Returns nullptr if the system has no page left; then nothing is recorded.
    static DoingPage* make();

    struct Seen {
        std::string what;      ///< empty: the driver is idle
        double seconds = 0;    ///< time since it began
        bool starting = false; ///< the driver itself is being started
    };
    Seen seen() const;
    /// Returns whether a driver was ever started: it then has threads of its own.
    bool has_driver() const { return has_driver_; }
    /// The current frame of a capture, from the start of its drawing to the start of the next. `begun` is
    /// false before the first frame: then `number` is the first one.
    struct Frame {
        int number = 0;
        bool begun = false;
    };
    std::optional<Frame> frame() const;
    /// Returns whether an interrupted run can be resumed.
    bool resumable() const { return resumable_; }

private:
    friend class Doing;
    void note(std::string_view what, int64_t since, bool starting);

    static constexpr size_t k_longest = 480;
    static constexpr int k_no_frame = std::numeric_limits<int>::min();
    std::atomic<uint32_t> size_;
    std::atomic<bool> starting_;
    std::atomic<bool> has_driver_;
    std::atomic<bool> resumable_;
    std::atomic<int> frame_ = k_no_frame;
    std::atomic<bool> begun_;
    std::atomic<int64_t> since_; ///< nanoseconds of the steady clock
    char what_[k_longest];
};

/// Records what the driver does while this object lives; the destructor restores the entry before it.
class Doing {
public:
    enum class Kind { work, start };

    /// `what` completes "the driver crashed …", as in "compiling Image of 'waves.glsl'".
    explicit Doing(std::string_view what, Kind kind = Kind::work);
    ~Doing();
    Doing(const Doing&) = delete;
    Doing& operator=(const Doing&) = delete;

    /// Sets the page that this process records on from now on; nullptr: none.
    static void note_on(DoingPage* page);
    /// Records the current frame of a capture; nullopt: none.
    static void note_frame(std::optional<DoingPage::Frame> frame);
    /// Records that the run can be resumed if it is interrupted from now on.
    static void note_resumable();
    /// Returns and clears the entry of a process that recorded on the same page and has crashed.
    static std::string left_behind();

private:
    DoingPage::Seen before_;
    int64_t since_before_ = 0;
};

} // namespace tidemark
