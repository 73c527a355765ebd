#include "cli/supervisor.hpp"

#include "base/doing.hpp"
#include "base/error.hpp"
#include "base/leftovers.hpp"
#include "cli/console.hpp"
#include "cli/diagnostics.hpp"
#include "cli/interrupt.hpp"
#include "cli/last_resort.hpp"
#include "cli/memory_limit.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <optional>
#include <utility>
#include <vector>

namespace tidemark::cli {
namespace {

/// For outputs whose files appear whole or not at all, however the process ends.
constexpr const char* k_words_on_resuming =
    "; what is on disk is whole, and the same command with --resume goes on";

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
            return refuse(ErrorCode::no_context,
                          fmt::format("{}: the driver hangs; --device names another", seen.what));
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
                          fmt::format("{} was ended from outside (SIGKILL), which is what a system does "
                                      "that has no memory left: --memory ends it before{}",
                                      seen.what.empty() ? "the command" : seen.what, cut_short(seen.what)));
        if (!is_crash(signal))
            end_by(signal);
        if (!seen.what.empty())
            return refuse(seen.starting ? ErrorCode::no_context : ErrorCode::load,
                          crash_text(signal, seen.what) +
                              (seen.starting ? "; --device names another" : cut_short(seen.what)));
        if (page_ && page_->has_driver()) // its threads may crash between calls, too
            return refuse(ErrorCode::load, crash_text(signal, "") + ", or tidemark itself" + cut_short(""));
        say(fmt::format("tidemark: error: tidemark itself crashed ({}), which is a defect of its own",
                        name_of(signal)));
        return k_internal_error;
    }

    pid_t child_;
    Limits limits_;
    const DoingPage* page_;
    bool requested_ = false; ///< the child was asked to end
    std::optional<Clock::time_point> give_up_at_{};
    unsigned looks_ = 0;
    std::vector<pid_t> family_; ///< descendants of the child at the last refresh
};

} // namespace

bool is_crash(int signal) {
    for (const int crash : {SIGSEGV, SIGABRT, SIGBUS, SIGILL, SIGFPE, SIGTRAP, SIGSYS})
        if (signal == crash)
            return true;
    return false;
}

std::string crash_text(int signal, const std::string& doing) {
    const char* hint = signal == SIGBUS ? ": is the disk full that its cache is on?" : "";
    return fmt::format("the driver crashed ({}){}{}{}", name_of(signal), doing.empty() ? "" : " ", doing,
                       hint);
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
    }
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    return std::nullopt;
}

} // namespace tidemark::cli
