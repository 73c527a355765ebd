// Watches work that may never end, such as a driver's compile or a frame. Prints that it is still running,
// and ends the process after a time limit, since a driver's call cannot be interrupted.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tidemark::cli {

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
        std::string what;                    ///< completes "still …" and "gave up …"
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

} // namespace tidemark::cli
