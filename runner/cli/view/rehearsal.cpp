#include "cli/view/rehearsal.hpp"

#include "base/doing.hpp"
#include "cli/forked.hpp"
#include "cli/memory_limit.hpp"
#include "cli/supervisor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <limits>
#include <string>

namespace tidemark::cli {
namespace {

constexpr int k_look_ms = 50;
/// One message is one answer.
constexpr size_t k_longest_answer = 1 << 16;
/// What the window asks for, what it does not want any more, and that all is well.
constexpr char k_try = '?', k_enough = '!', k_well = '\n';

/// A driver has its own words on standard error, and warnings were said by the window's own load.
void be_quiet() {
    if (const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nothing >= 0)
        ::dup2(nothing, STDERR_FILENO);
}

/// While a try is under way the window has nothing to say but that it is enough, or that it is gone.
bool has_word(int socket) {
    pollfd wait{socket, POLLIN, 0};
    return ::poll(&wait, 1, 0) != 0;
}

/// What is wrong, if anything.
std::string tried(const Rehearsal::Play& play, uint64_t memory, int socket) {
    ForkedLimits limits{.seconds = std::numeric_limits<double>::infinity(), .memory = memory};
    limits.unwanted = [socket] { return has_word(socket); };
    const auto run = run_forked(
        [&](const Tell&) {
            be_quiet();
            play();
        },
        limits);
    if (!run)
        return run.error().message;
    if (run->over_memory)
        return fmt::format("{} takes more than {} of memory (--memory)",
                           run->doing.empty() ? "the scene" : run->doing, memory_text(memory));
    return run->crash;
}

[[noreturn]] void be_child(pid_t parent, int socket, const Rehearsal::Play& play, uint64_t memory) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent)
        ::_exit(128 + SIGKILL);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) // the window decides when it ends
        std::signal(signal, SIG_IGN);
    Doing::note_on(DoingPage::make());
    for (char word = 0;;) {
        const ssize_t count = ::read(socket, &word, 1);
        if (count == 0 || (count < 0 && errno != EINTR))
            ::_exit(0);
        if (count < 0 || word != k_try) // it came when the answer was on its way
            continue;
        std::string answer = tried(play, memory, socket);
        answer.resize(std::min(answer.size(), k_longest_answer));
        if (answer.empty())
            answer = k_well;
        if (::send(socket, answer.data(), answer.size(), MSG_NOSIGNAL) < 0)
            ::_exit(0);
    }
}

} // namespace

std::shared_ptr<Rehearsal> Rehearsal::start(const Play& play, uint64_t memory) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
        return nullptr;
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(ends[0]);
        be_child(parent, ends[1], play, memory);
    }
    ::close(ends[1]);
    if (child < 0) {
        ::close(ends[0]);
        return nullptr;
    }
    return std::shared_ptr<Rehearsal>(new Rehearsal(child, ends[0]));
}

Rehearsal::~Rehearsal() {
    ::close(socket_);
    ::kill(child_, SIGKILL); // what it has under way ends with it
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

Result<void> Rehearsal::try_out(const std::function<bool()>& unwanted) {
    const std::lock_guard lock(one_);
    const auto gone = [] { return fail(ErrorCode::load, "the process that tries scenes out is gone"); };
    if (::send(socket_, &k_try, 1, MSG_NOSIGNAL) < 0)
        return gone();
    for (bool told = false;;) { // that it is enough
        pollfd wait{socket_, POLLIN, 0};
        if (::poll(&wait, 1, k_look_ms) <= 0) {
            told = told || (unwanted() && ::send(socket_, &k_enough, 1, MSG_NOSIGNAL) > 0);
            continue;
        }
        std::string answer(k_longest_answer, '\0');
        const ssize_t count = ::recv(socket_, answer.data(), answer.size(), 0);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return gone();
        answer.resize(size_t(count));
        if (answer.front() == k_well)
            return {};
        return fail(ErrorCode::load, std::move(answer));
    }
}

} // namespace tidemark::cli
