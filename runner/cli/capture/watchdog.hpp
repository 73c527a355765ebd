// Keeps an eye on work that may never end: a driver that compiles, a frame that is drawn. Says that it still
// goes on, and gives up when it takes too long. A driver cannot be interrupted, so giving up ends the
// process.
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
    /// `before_exit` is called (on the watchdog's thread) before the process ends by a limit: what can be
    /// finished without the stuck thread is finished there. A Watch that ends meanwhile does not return.
    explicit Watchdog(std::function<void()> before_exit = {});
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    using Clock = std::chrono::steady_clock;

    /// Watches until it is destroyed. `what` completes "still …" and "gave up on …". The limit counts from
    /// `start`.
    class Watch {
    public:
        Watch(Watchdog& dog, std::string what, std::optional<double> limit_seconds,
              Clock::time_point start = Clock::now());
        ~Watch();
        Watch(const Watch&) = delete;
        Watch& operator=(const Watch&) = delete;

    private:
        Watchdog& dog_;
    };

private:
    struct Work {
        std::string what;
        Clock::time_point start;
        std::optional<Clock::time_point> deadline;
        Clock::time_point next_word;

        /// When something is due.
        Clock::time_point wake() const;
    };

    void run();
    void speak_or_end();

    std::function<void()> before_exit_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Work> work_;
    Clock::time_point wakes_ = Clock::time_point::max(); ///< of itself
    bool ending_ = false;
    std::thread thread_;
};

} // namespace tidemark::cli
