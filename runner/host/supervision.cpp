#include "host/supervision.hpp"

#include "base/error.hpp"
#include "base/supervision.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace tidemark::host {
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

constexpr int k_no_resources = 4;

/// Writes without allocating, as memory may have run out.
void say_at_once(std::string_view line) {
    (void)!::write(STDERR_FILENO, line.data(), line.size());
}

[[noreturn]] void end() {
    if (std::current_exception())
        exit_at_once(last_resort());
    say_at_once(
        "tidemark: error: internal error: a library ended the program; threads or memory may have run out\n");
    exit_at_once(k_internal_error);
}

/// For outputs whose files appear whole or not at all, however the process ends.
constexpr const char* k_words_on_resuming =
    "; the files on disk are complete; to continue, run the same command with --resume";

/// Seconds between two checks of memory: a process grows by some hundred MiB at most meanwhile.
constexpr double k_look_seconds = 0.05;
/// Checks per refresh of the process list: listing processes takes a hundred times as long as reading their
/// memory.
constexpr unsigned k_looks_at_one_family = 20;
/// A driver that needs longer to start hangs. In seconds.
constexpr double k_longest_start = 60;

constexpr int k_handed_on[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGCONT};

sigset_t signals_of_interest() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : k_handed_on)
        sigaddset(&set, signal);
    sigaddset(&set, SIGTSTP);
    sigaddset(&set, SIGCHLD);
    return set;
}

/// Kills descendants whose parent has ended, for example a video encoder.
void end_orphans() {
    for (const pid_t process : descendants_of(::getpid()))
        ::kill(process, SIGKILL);
    while (::waitpid(-1, nullptr, 0) > 0 || errno == EINTR) {
    }
}

/// Ends with the child's signal, so that our parent process sees the same status.
[[noreturn]] void end_by(int signal) {
    std::signal(signal, SIG_DFL);
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, signal);
    ::sigprocmask(SIG_UNBLOCK, &only, nullptr);
    ::raise(signal);
    ::_exit(128 + signal);
}

std::string name_of(int signal) {
    const char* name = ::sigabbrev_np(signal);
    return name ? fmt::format("SIG{}", name) : fmt::format("signal {}", signal);
}

int refuse(ErrorCode code, std::string message) {
    say(Error{code, std::move(message), {}});
    return exit_code(code);
}

/// Returns true for signals of a crash, not for requests to end.
bool is_crash(int signal) {
    for (const int crash : {SIGSEGV, SIGABRT, SIGBUS, SIGILL, SIGFPE, SIGTRAP, SIGSYS})
        if (signal == crash)
            return true;
    return false;
}

class Supervisor {
    using Clock = std::chrono::steady_clock;

public:
    Supervisor(pid_t child, const Limits& limits, const DoingPage* page)
        : child_(child), limits_(limits), page_(page) {}

    int run() {
        const sigset_t signals = signals_of_interest();
        for (;;) {
            const timespec look{0, long(k_look_seconds * 1e9)};
            siginfo_t info{};
            const int signal = ::sigtimedwait(&signals, &info, &look);
            if (signal == SIGCHLD || signal < 0) {
                int status = 0;
                if (has_ended(status))
                    return after(status);
            } else if (signal == SIGTSTP) {
                ::kill(-child_, SIGSTOP);
                ::raise(SIGSTOP);
            } else {
                ::kill(signal == SIGCONT ? -child_ : child_, signal);
                note_request(signal);
            }
            if (give_up_at_ && Clock::now() >= *give_up_at_) {
                end_child();
                return Interrupt::k_exit_code;
            }
            if (const auto ended = beyond_limits())
                return *ended;
        }
    }

private:
    /// The first request is left to the child, which is continued if it was stopped; after a second one the
    /// child is killed unless it ends within a second.
    void note_request(int signal) {
        constexpr std::chrono::seconds k_last_moment(1);
        if (signal != SIGINT && signal != SIGTERM && signal != SIGHUP && signal != SIGQUIT)
            return;
        ::kill(-child_, SIGCONT);
        if (std::exchange(requested_, true) && signal != SIGHUP) // a closing terminal sends several SIGHUP
            give_up_at_ = give_up_at_.value_or(Clock::now() + k_last_moment);
    }

    /// Also reaps descendants that lost their parent.
    bool has_ended(int& status) const {
        for (int of_one = 0;;) {
            const pid_t process = ::waitpid(-1, &of_one, WNOHANG);
            if (process == child_) {
                status = of_one;
                return true;
            }
            if (process == 0 || (process < 0 && errno != EINTR))
                return false;
        }
    }

    void end_child() const {
        ::kill(-child_, SIGKILL);
        end_orphans();
        clear_leftovers_of_the_dead();
    }

    std::optional<int> beyond_limits() {
        if (limits_.memory > 0) {
            if (++looks_ % k_looks_at_one_family == 0)
                family_ = descendants_of(child_);
            uint64_t taken = memory_of(child_);
            for (const pid_t process : family_)
                taken += memory_of(process);
            if (taken > limits_.memory)
                return give_up(fmt::format("more than {} of memory (--memory)", memory_text(limits_.memory)));
        }
        if (!page_)
            return std::nullopt;
        const DoingPage::Seen seen = page_->seen();
        if (seen.what.empty())
            return std::nullopt;
        if (seen.starting && seen.seconds > k_longest_start) {
            end_child();
            return refuse(
                ErrorCode::no_context,
                fmt::format("{}: the driver hangs; choose another device with --device", seen.what));
        }
        if (limits_.seconds && seen.seconds > *limits_.seconds)
            return give_up(fmt::format("more than {:.3g} s (--timeout)", *limits_.seconds));
        return std::nullopt;
    }

    int give_up(const std::string& limit) const {
        const std::string what = page_ ? page_->seen().what : std::string();
        end_child();
        return refuse(ErrorCode::timed_out, fmt::format("{} takes {}{}", what.empty() ? "the command" : what,
                                                        limit, cut_short(what)));
    }

    /// Returns the frame that a capture was in or before, unless `what` already names the work before the
    /// first frame, and how to resume.
    std::string cut_short(const std::string& what) const {
        const auto frame = page_ ? page_->frame() : std::nullopt;
        const bool named = frame && (frame->begun || what.empty());
        return (named ? fmt::format(" ({} frame {})", frame->begun ? "in" : "before", frame->number) : "") +
               (page_ && page_->resumable() ? k_words_on_resuming : "");
    }

    int after(int status) const {
        end_orphans();
        clear_leftovers_of_the_dead();
        if (WIFEXITED(status))
            return WEXITSTATUS(status);
        const int signal = WTERMSIG(status);
        const DoingPage::Seen seen = page_ ? page_->seen() : DoingPage::Seen{};
        if (signal == SIGKILL)
            return refuse(ErrorCode::timed_out,
                          fmt::format("{} was killed from outside (SIGKILL), probably because the system ran "
                                      "out of memory: a lower --memory stops it earlier{}",
                                      seen.what.empty() ? "the command" : seen.what, cut_short(seen.what)));
        if (!is_crash(signal))
            end_by(signal);
        if (!seen.what.empty())
            return refuse(seen.starting ? ErrorCode::no_context : ErrorCode::load,
                          crash_text(signal, seen.what) + (seen.starting
                                                               ? "; choose another device with --device"
                                                               : cut_short(seen.what)));
        if (page_ && page_->has_driver()) // its threads may crash between calls, too
            return refuse(ErrorCode::load, crash_text(signal, "") + ", or tidemark itself" + cut_short(""));
        say(fmt::format("tidemark: error: tidemark itself crashed ({}); this is a bug in tidemark",
                        name_of(signal)));
        return k_internal_error;
    }

    pid_t child_;
    Limits limits_;
    const DoingPage* page_;
    bool requested_ = false; ///< the child was sent a request to end
    std::optional<Clock::time_point> give_up_at_{};
    unsigned looks_ = 0;
    std::vector<pid_t> family_; ///< descendants of the child at the last refresh
};

} // namespace

Interrupt::Interrupt() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) // SIGUSR1 wakes the listener so that it can end
        sigaddset(&signals_, signal);
    struct sigaction hang_up {};
    sigaction(SIGHUP, nullptr, &hang_up);
    if (hang_up.sa_handler != SIG_IGN) // ignored for example under nohup
        sigaddset(&signals_, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals_, &previous_mask_);
    // Wait until the listener runs: a fork while a thread is starting could copy a lock that is never
    // released, and the child would wait for it.
    listener_ = std::thread([this] {
        started_.count_down();
        int signal = 0;
        while (sigwait(&signals_, &signal) == 0) {
            if (ending_)
                return;
            // When a terminal closes, the kernel and the shell both send SIGHUP: count that as one request.
            if (signal != SIGUSR1 && ((requested_.exchange(true) && signal != SIGHUP) || immediate_))
                exit_at_once(k_exit_code);
            const std::lock_guard lock(mutex_);
            if (wake_)
                wake_();
        }
    });
    started_.wait();
}

void Interrupt::wake_by(std::function<void()> wake) {
    const std::lock_guard lock(mutex_);
    wake_ = std::move(wake);
}

Interrupt::~Interrupt() {
    ending_ = true;
    pthread_kill(listener_.native_handle(), SIGUSR1);
    listener_.join();
    pthread_sigmask(SIG_SETMASK, &previous_mask_, nullptr);
}

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
            "Ctrl-C stops after this frame, a second Ctrl-C at once"};
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
        end(fmt::format("stopped {} after {:.3g} s (--timeout)", work_->task.what, seconds),
            exit_code(ErrorCode::timed_out));
    if (work_->is_unwanted_for_long(now))
        end(fmt::format("stopped {} after {:.3g} s: interrupted", work_->task.what, seconds),
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

void end_by_last_resort() {
    std::set_terminate(end);
}

int last_resort() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        say_at_once("tidemark: error: out of memory\n");
        return k_no_resources;
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again) {
            say_at_once("tidemark: error: cannot start another thread: the system's limit is reached\n");
            return k_no_resources;
        }
        say(std::string("tidemark: error: internal error: ") + error.what());
    } catch (const std::exception& error) {
        say(std::string("tidemark: error: internal error: ") + error.what());
    } catch (...) {
        say_at_once("tidemark: error: internal error: an unknown exception\n");
    }
    return k_internal_error;
}

std::string crash_text(int signal, const std::string& doing) {
    const char* hint = signal == SIGBUS ? ": the disk with its cache may be full" : "";
    return fmt::format("the driver crashed ({}){}{}{}", name_of(signal), doing.empty() ? "" : " ", doing,
                       hint);
}

namespace {
uint64_t g_memory = 0; ///< of the supervised command that this process belongs to
}

uint64_t memory_of_a_part() {
    return g_memory / 4 * 3;
}

std::optional<int> supervise(const Limits& limits) {
    DoingPage* page = DoingPage::make();
    sigset_t before;
    const sigset_t signals = signals_of_interest();
    ::sigprocmask(SIG_BLOCK, &signals, &before);
    std::signal(SIGCHLD, SIG_DFL); // if it is ignored, the parent cannot wait for its child
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child > 0) {
        ::setpgid(child, child); // both set it, since either may run first
        ::prctl(PR_SET_CHILD_SUBREAPER, 1);
        return Supervisor(child, limits, page).run();
    }
    if (child == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent)
            ::_exit(128 + SIGKILL);
        ::setpgid(0, 0);
        std::signal(SIGTTOU, SIG_IGN); // lets a background process group write to the terminal
        Doing::note_on(page);
        g_memory = limits.memory;
    }
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    return std::nullopt;
}

} // namespace tidemark::host
