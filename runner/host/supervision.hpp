// Ends of a process: Ctrl-C, time limits, unexpected exceptions, and a supervisor for crashes.
//
// Ctrl-C as a flag: the first request stops after the current work, the second one ends the process.
#pragma once

#include "host/forked.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <functional>
#include <latch>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tidemark::host {

/// Handles SIGINT, SIGTERM and SIGHUP while it lives. Construct it before any other thread, so that the
/// threads inherit its signal mask.
class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    bool requested() const { return requested_; }

    /// While it lives, the first request ends the process too: the driver is busy, and nothing needs to be
    /// finished.
    class Immediate {
    public:
        explicit Immediate(Interrupt& interrupt) : interrupt_(interrupt) { interrupt_.immediate_ = true; }
        ~Immediate() { interrupt_.immediate_ = false; }
        Immediate(const Immediate&) = delete;
        Immediate& operator=(const Immediate&) = delete;

    private:
        Interrupt& interrupt_;
    };

    /// While it lives, a request calls `wake` on the listener thread, to end a wait for something else.
    class Waking {
    public:
        Waking(Interrupt& interrupt, std::function<void()> wake) : interrupt_(interrupt) {
            interrupt_.wake_by(std::move(wake));
        }
        ~Waking() { interrupt_.wake_by(nullptr); }
        Waking(const Waking&) = delete;
        Waking& operator=(const Waking&) = delete;

    private:
        Interrupt& interrupt_;
    };

    static constexpr int k_exit_code = 130; ///< the exit code that shells report for SIGINT

private:
    void wake_by(std::function<void()> wake);

    sigset_t signals_{};
    sigset_t previous_mask_{};
    std::atomic<bool> requested_ = false;
    std::atomic<bool> immediate_ = false;
    std::atomic<bool> ending_ = false;
    std::mutex mutex_;
    std::function<void()> wake_; ///< guarded by mutex_
    std::latch started_{1};
    std::thread listener_;
};

// Watches work that may never end, such as a driver's compile or a frame. Prints that it is still running,
// and ends the process after a time limit, since a driver's call cannot be interrupted.

class Watchdog {
public:
    /// `before_exit` is called on the watchdog's thread before a limit ends the process, to finish what does
    /// not need the stuck thread. A Watch that ends meanwhile does not return.
    explicit Watchdog(std::function<void()> before_exit = {});
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    using Clock = std::chrono::steady_clock;

    struct Task {
        std::string what;                    ///< completes "still …" and "stopped …"
        std::optional<double> limit_seconds; ///< from `start` on
        Clock::time_point start = Clock::now();
        const char* how_to_end = "Ctrl-C ends it";
        /// Called on the watchdog's thread: once it has returned true for two seconds, the process ends as by
        /// Ctrl-C.
        std::function<bool()> unwanted{};
    };

    /// Returns the task of drawing a frame. Its message says that the first Ctrl-C stops the capture after
    /// this frame.
    static Task frame_task(int frame, std::optional<double> limit_seconds, Clock::time_point start);

    /// Watches until it is destroyed.
    class Watch {
    public:
        Watch(Watchdog& dog, Task task);
        ~Watch();
        Watch(const Watch&) = delete;
        Watch& operator=(const Watch&) = delete;

    private:
        Watchdog& dog_;
    };

private:
    struct Work {
        Task task;
        std::optional<Clock::time_point> deadline;
        Clock::time_point next_word;
        std::optional<Clock::time_point> unwanted_since{};

        /// Returns when the next action is due.
        Clock::time_point wake() const;
        bool is_unwanted_for_long(Clock::time_point now);
    };

    void run();
    void speak_or_end();
    void end(const std::string& why, int code);

    std::function<void()> before_exit_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Work> work_;
    Clock::time_point wakes_ = Clock::time_point::max(); ///< when the thread wakes without being notified
    bool ending_ = false;
    std::thread thread_;
};

// Handles unexpected ends of the process: memory or threads that ran out, or a library's exception that was
// not caught where the library was called. Prints one line on standard error and ends with an exit code,
// without a core dump.

/// The exit code of an internal error: EX_SOFTWARE of sysexits.h.
inline constexpr int k_internal_error = 70;

/// Installs the handler for exceptions that escape on any thread.
void end_by_last_resort();

/// Prints the message for the current exception and returns the exit code. Call it in a catch block of the
/// main thread.
int last_resort();

// Runs the command in a supervised child process: if a driver crashes or takes too much memory, the command
// ends with a message and an exit code instead of a bare signal.

/// Forks; call it before there are threads, a driver or anything to clean up. Returns nothing in the child,
/// which goes on with the command; in the parent it returns the exit code once the child has ended. If fork
/// fails, the command goes on unsupervised.
///
/// The child has its own process group, so that a signal reaches it once, passed on by the parent. It is
/// killed if the parent ends, however the parent ends.
std::optional<int> supervise(const Limits& limits);

/// Returns a limit for one part of a supervised command, run by run_forked, so that only that part ends where
/// the command would: three quarters of the memory that it may take. 0: no limit.
uint64_t memory_of_a_part();

/// Returns for example "the driver crashed (SIGSEGV) compiling Image of 'a.glsl'"; `doing` may be empty.
std::string crash_text(int signal, const std::string& doing);

} // namespace tidemark::host
