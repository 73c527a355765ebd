#include "cli/capture/watchdog.hpp"

#include "base/error.hpp"
#include "base/leftovers.hpp"
#include "cli/console.hpp"
#include "cli/diagnostics.hpp"

#include <fmt/format.h>

namespace tidemark::cli {
namespace {

/// A person waits so long without a word, and hears one so often from then on.
constexpr std::chrono::seconds k_first_word{3};
constexpr std::chrono::seconds k_next_word{10};

std::chrono::steady_clock::duration from_seconds(double seconds) {
    // Beyond a year the clock's own numbers overflow.
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(std::min(seconds, 3e7)));
}

} // namespace

Watchdog::Watchdog(std::function<void()> before_exit)
    : before_exit_(std::move(before_exit)), thread_([this] { run(); }) {}

Watchdog::~Watchdog() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

Watchdog::Watch::Watch(Watchdog& dog, std::string what, std::optional<double> limit_seconds,
                       Clock::time_point start)
    : dog_(dog) {
    Work work{std::move(what), start, std::nullopt, Clock::now() + k_first_word};
    if (limit_seconds)
        work.deadline = start + from_seconds(*limit_seconds);
    const std::lock_guard lock(dog_.mutex_);
    // Not woken for each frame: it looks at what there is when it wakes by itself.
    if (work.wake() < dog_.wakes_)
        dog_.changed_.notify_all();
    dog_.work_ = std::move(work);
}

Watchdog::Watch::~Watch() {
    const std::lock_guard lock(dog_.mutex_);
    dog_.work_.reset();
}

Watchdog::Clock::time_point Watchdog::Work::wake() const {
    return deadline ? std::min(*deadline, next_word) : next_word;
}

void Watchdog::run() {
    std::unique_lock lock(mutex_);
    while (!ending_) {
        if (work_ && work_->wake() <= Clock::now()) {
            speak_or_end();
        } else if (work_) {
            wakes_ = work_->wake();
            changed_.wait_until(lock, wakes_);
        } else {
            wakes_ = Clock::time_point::max();
            changed_.wait(lock);
        }
    }
}

/// With the lock held, to the end: work that is done in this very moment waits in ~Watch, and nobody else
/// uses what `before_exit_` takes down.
void Watchdog::speak_or_end() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - work_->start).count();
    if (work_->deadline && now >= *work_->deadline) {
        if (before_exit_)
            before_exit_();
        say(Error{ErrorCode::timed_out,
                  fmt::format("gave up {} after {:.3g} s (--timeout)", work_->what, seconds),
                  {}});
        finish_diagnostics(true);
        exit_at_once(exit_code(ErrorCode::timed_out));
    }
    if (now >= work_->next_word) {
        say(fmt::format("still {} after {:.0f} s; Ctrl-C ends it", work_->what, seconds));
        work_->next_word = now + k_next_word;
    }
}

} // namespace tidemark::cli
