#include "window/rehearsal.hpp"

#include "base/supervision.hpp"
#include "host/forked.hpp"
#include "host/supervision.hpp"

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
#include <string>
#include <string_view>
#include <utility>

namespace tidemark::cli {
namespace {

constexpr int k_look_ms = 50;
/// Bytes of a message, which is one request or one answer.
constexpr size_t k_longest_message = 1 << 16;
/// First byte of a request (k_try), the message that cancels it (k_enough), and the answer for success
/// (k_well).
constexpr char k_try = '?', k_enough = '!', k_well = '\n';
/// Marks of the values in a request: each value is a mark, `NAME=VALUE` and a zero byte.
constexpr char k_set = 's', k_define = 'd';

std::string question(const HeldTexts& held) {
    std::string text(1, k_try);
    for (const auto& [mark, texts] : {std::pair(k_set, &held.sets), std::pair(k_define, &held.defines)})
        for (const std::string& each : *texts)
            text.append(1, mark).append(each).append(1, '\0');
    return text;
}

HeldTexts held_in(std::string_view question) {
    HeldTexts held;
    for (question.remove_prefix(1); !question.empty();) {
        const size_t end = std::min(question.find('\0'), question.size() - 1);
        auto& texts = question.front() == k_set ? held.sets : held.defines;
        texts.emplace_back(question.substr(1, end - 1));
        question.remove_prefix(end + 1);
    }
    return held;
}

/// Silences standard error: drivers print there, and the window's own load has printed the warnings.
void be_quiet() {
    if (const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nothing >= 0)
        ::dup2(nothing, STDERR_FILENO);
}

/// Returns whether a message waits or the window has closed the socket. During a try both mean that it is
/// cancelled.
bool has_word(int socket) {
    pollfd wait{socket, POLLIN, 0};
    return ::poll(&wait, 1, 0) != 0;
}

/// Returns what is wrong; empty: nothing.
std::string tried(const Rehearsal::Play& play, const HeldTexts& held, uint64_t memory, int socket) {
    const auto run = run_forked(
        [&](const Tell&) {
            be_quiet();
            play(held);
        },
        {.memory = memory, .unwanted = [socket] { return has_word(socket); }});
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
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) // the window decides when this process ends
        std::signal(signal, SIG_IGN);
    Doing::note_on(DoingPage::make());
    while (true) {
        std::string message(k_longest_message, '\0');
        const ssize_t count = ::recv(socket, message.data(), message.size(), 0);
        if (count == 0 || (count < 0 && errno != EINTR))
            ::_exit(0);
        if (count < 0 || message.front() != k_try) // the cancellation crossed the answer
            continue;
        message.resize(size_t(count));
        std::string answer = tried(play, held_in(message), memory, socket);
        answer.resize(std::min(answer.size(), k_longest_message));
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
    ::kill(child_, SIGKILL); // kills the try in progress, too
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

Result<void> Rehearsal::try_out(const HeldTexts& held, const std::function<bool()>& unwanted) {
    const std::lock_guard lock(one_);
    const std::string asked = question(held);
    if (asked.size() > k_longest_message)
        return fail(
            ErrorCode::load,
            fmt::format(
                "the values given for knobs and definitions have {} bytes: at most {} can be tried out",
                asked.size(), k_longest_message));
    const auto gone = [] { return fail(ErrorCode::load, "the process that tries scenes out has ended"); };
    if (::send(socket_, asked.data(), asked.size(), MSG_NOSIGNAL) < 0)
        return gone();
    for (bool told = false;;) { // whether it was cancelled
        pollfd wait{socket_, POLLIN, 0};
        if (::poll(&wait, 1, k_look_ms) <= 0) {
            told = told || (unwanted() && ::send(socket_, &k_enough, 1, MSG_NOSIGNAL) > 0);
            continue;
        }
        std::string answer(k_longest_message, '\0');
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
