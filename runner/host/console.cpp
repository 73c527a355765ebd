#include "host/console.hpp"

#include "base/encoding.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <mutex>

namespace tidemark::host {

const char* const k_version = TIDEMARK_VERSION;
namespace {

std::atomic<bool> words_are_wanted{true};

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

const std::string k_clear_line = "\r\x1b[K";

/// Prints without a line end, so that the next line can overwrite it.
void show(const std::string& text) {
    (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Redrawing more often than about ten times a second is not readable.
constexpr double k_redraw_seconds = 0.1;

} // namespace

void say(std::string_view line) {
    if (words_are_wanted)
        say_to_programs(line);
}

void say_to_programs(std::string_view line) {
    const std::string text = printable(line) + '\n'; // one write, so that lines of several threads do not mix
    (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

void keep_words_back() {
    words_are_wanted = false;
}

Result<void> put(std::string_view text) {
    const std::string shown = printable(text);
    return put(std::as_bytes(std::span(shown)));
}

Result<void> put_exact(std::string_view text) {
    return ::isatty(STDOUT_FILENO) == 1 ? put(text) : put(std::as_bytes(std::span(text)));
}

Result<void> put(std::span<const std::byte> bytes) {
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
    if (written && std::fflush(stdout) == 0)
        return {};
    return fail(ErrorCode::write, fmt::format("cannot write to standard output: {}", system_reason(errno)));
}

Progress::Progress(std::string what, size_t total, Manner manner)
    : what_(std::move(what)), total_(total), manner_(manner), terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()), shown_(start_), first_done_(start_) {}

Progress::~Progress() {
    step_aside();
}

void Progress::step_aside() {
    if (on_terminal_)
        show(k_clear_line);
    on_terminal_ = false;
}

void Progress::advance() {
    ++done_;
    const Clock::time_point now = Clock::now();
    if (done_ == 1)
        first_done_ = now;
    if (total_ < 2 || seconds_between(start_, now) < manner_.silent)
        return;
    if (terminal_ && (!on_terminal_ || seconds_between(shown_, now) > k_redraw_seconds || done_ == total_)) {
        show(k_clear_line + printable_line(line()));
        shown_ = now;
        on_terminal_ = true;
    } else if (!terminal_ && (done_ * 10 / total_ > (done_ - 1) * 10 / total_ ||
                              seconds_between(shown_, now) > manner_.between)) {
        say(line());
        shown_ = now;
    }
}

/// The first piece includes one-time work (the driver compiles at the first draw), so the rate excludes it as
/// soon as there is a second.
std::string Progress::line() const {
    const Clock::time_point now = Clock::now();
    if (manner_.limit)
        return fmt::format("{}/{} {}, at most {:.0f} s left", done_, total_, what_,
                           std::max(0.0, *manner_.limit - seconds_between(start_, now)));
    const double counted = done_ > 1 ? double(done_ - 1) : 1.0;
    const double elapsed = seconds_between(done_ > 1 ? first_done_ : start_, now);
    const double rate = elapsed > 0 ? counted / elapsed : 0;
    const double left = rate > 0 ? double(total_ - done_) / rate : 0;
    const std::string shown_rate = rate < 100 ? fmt::format("{:.3g}", rate) : fmt::format("{:.0f}", rate);
    return fmt::format("{}/{} {}, {} a second, {:.0f} s left", done_, total_, what_, shown_rate, left);
}

SlowNotice::SlowNotice(std::string message, std::chrono::milliseconds delay)
    : thread_([message = std::move(message), delay](const std::stop_token& stop) {
          std::mutex mutex;
          std::unique_lock lock(mutex);
          std::condition_variable_any stopped;
          stopped.wait_for(lock, stop, delay, [] { return false; });
          if (!stop.stop_requested())
              say(message);
      }) {}

} // namespace tidemark::host
