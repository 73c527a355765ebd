#include "cli/capture/watchdog.hpp"

#include "base/error.hpp"
#include "base/leftovers.hpp"
#include "cli/console.hpp"
#include "cli/diagnostics.hpp"
#include "cli/interrupt.hpp"

#include <fmt/format.h>

namespace tidemark::cli {
namespace {

/// The first message comes after this time, the following ones at this interval.
constexpr std::chrono::seconds k_first_word{3};
constexpr std::chrono::seconds k_next_word{10};
/// The interval between two calls of `unwanted`, and how long work may go on once it is unwanted.
constexpr std::chrono::milliseconds k_look{200};
constexpr std::chrono::seconds k_unwanted{2};

std::chrono::steady_clock::duration from_seconds(double seconds) {
    // Above a year (3e7 s) the clock's integers could overflow.
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

Watchdog::Watch::Watch(Watchdog& dog, Task task) : dog_(dog) {
    Work work{std::move(task), std::nullopt, Clock::now() + k_first_word};
    if (work.task.limit_seconds)
        work.deadline = work.task.start + from_seconds(*work.task.limit_seconds);
    const std::lock_guard lock(dog_.mutex_);
    // The thread is not woken for each frame: when it wakes on its own, it reads the current task.
    if (work.wake() < dog_.wakes_)
        dog_.changed_.notify_all();
    dog_.work_ = std::move(work);
}

Watchdog::Task Watchdog::frame_task(int frame, std::optional<double> limit_seconds, Clock::time_point start) {
    return {fmt::format("drawing frame {}", frame), limit_seconds, start,
            "Ctrl-C stops behind this frame, a second one at once"};
}

Watchdog::Watch::~Watch() {
    const std::lock_guard lock(dog_.mutex_);
    dog_.work_.reset();
}

Watchdog::Clock::time_point Watchdog::Work::wake() const {
    const auto due = deadline ? std::min(*deadline, next_word) : next_word;
    return task.unwanted ? std::min(due, Clock::now() + k_look) : due;
}

bool Watchdog::Work::is_unwanted_for_long(Clock::time_point now) {
    if (!task.unwanted || !task.unwanted())
        return false;
    unwanted_since = unwanted_since.value_or(now);
    return now - *unwanted_since > k_unwanted;
}

void Watchdog::run() {
    std::unique_lock lock(mutex_);
    while (!ending_) {
        if (work_) {
            speak_or_end();
            wakes_ = work_->wake();
            changed_.wait_until(lock, wakes_);
        } else {
            wakes_ = Clock::time_point::max();
            changed_.wait(lock);
        }
    }
}

/// Prints a message or ends the process. Holds the lock until the end: work that finishes at this moment
/// waits in ~Watch, so that nothing else uses what `before_exit_` closes.
void Watchdog::speak_or_end() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - work_->task.start).count();
    if (work_->deadline && now >= *work_->deadline)
        end(fmt::format("gave up {} after {:.3g} s (--timeout)", work_->task.what, seconds),
            exit_code(ErrorCode::timed_out));
    if (work_->is_unwanted_for_long(now))
        end(fmt::format("gave up {} after {:.3g} s: interrupted", work_->task.what, seconds),
            Interrupt::k_exit_code);
    if (now >= work_->next_word) {
        say(fmt::format("still {} after {:.0f} s; {}", work_->task.what, seconds, work_->task.how_to_end));
        work_->next_word = now + k_next_word;
    }
}

void Watchdog::end(const std::string& why, int code) {
    if (before_exit_)
        before_exit_();
    say(Error{ErrorCode::timed_out, why, {}});
    finish_diagnostics(true);
    exit_at_once(code);
}

} // namespace tidemark::cli
