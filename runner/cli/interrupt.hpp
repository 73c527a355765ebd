// Ctrl-C as a flag: the first request asks to stop after the current work, the second one ends the process.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <latch>
#include <mutex>
#include <thread>

namespace tidemark::cli {

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

} // namespace tidemark::cli
