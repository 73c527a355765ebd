#include "cli/forked.hpp"

#include "base/doing.hpp"
#include "cli/memory_limit.hpp"
#include "cli/supervisor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <utility>

namespace tidemark::cli {
namespace {

using Clock = std::chrono::steady_clock;

void write_line(int fd, std::string_view line) {
    std::string text(line);
    text += '\n';
    for (size_t written = 0; written < text.size();) {
        const ssize_t count = ::write(fd, text.data() + written, text.size() - written);
        if (count < 0 && errno != EINTR)
            return; // the parent has ended
        written += count > 0 ? size_t(count) : 0;
    }
}

/// Returns one line without its end; nothing if the parent ended without a question.
std::optional<std::string> read_line(int fd) {
    std::string line;
    for (char c = 0;;) {
        const ssize_t count = ::read(fd, &c, 1);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return std::nullopt;
        if (c == '\n')
            return line;
        line += c;
    }
}

/// Runs in the child. `noexcept`, because an exception would unwind into the parent's stack and its open
/// files.
[[noreturn]] void be_child(pid_t parent, int questions, int answers,
                           const ForkedHelper::Work& work) noexcept {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL); // Ctrl-C in the parent ends the child too
    if (::getppid() != parent)
        ::_exit(128 + SIGKILL);
    if (const auto question = read_line(questions))
        work(*question, [answers](std::string_view line) { write_line(answers, line); });
    ::_exit(0); // skips destructors of a driver, which may hang
}

/// The interval between two checks of a child's limits.
constexpr long k_look_ms = 50;

/// Returns true if a running child exceeds a limit; sets the reason in `result`.
bool has_to_end(pid_t child, const ForkedLimits& limits, Clock::time_point deadline, ForkedResult& result) {
    result.timed_out = Clock::now() >= deadline;
    result.over_memory = limits.memory > 0 && memory_of(child) > limits.memory;
    result.unwanted = limits.unwanted && limits.unwanted();
    return result.timed_out || result.over_memory || result.unwanted;
}

void close_both(const std::array<int, 2>& ends) {
    ::close(ends[0]);
    ::close(ends[1]);
}

int status_of(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// Describes how the child crashed; empty if it succeeded. Drivers also call exit() for errors that they
/// cannot report otherwise.
std::string crash_of(int status, const std::string& doing) {
    if (WIFSIGNALED(status))
        return crash_text(WTERMSIG(status), doing);
    if (WEXITSTATUS(status) != 0)
        return fmt::format("the driver ended the process (exit code {}){}{}", WEXITSTATUS(status),
                           doing.empty() ? "" : " ", doing);
    return {};
}

} // namespace

Result<ForkedHelper> ForkedHelper::start(const Work& work) {
    std::array<int, 2> questions{}, answers{};
    if (::pipe2(questions.data(), O_CLOEXEC) != 0)
        return fail(ErrorCode::load, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    if (::pipe2(answers.data(), O_CLOEXEC) != 0) {
        close_both(questions);
        return fail(ErrorCode::load, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    }
    ForkedHelper helper;
    const pid_t parent = ::getpid();
    helper.child_ = ::fork();
    if (helper.child_ < 0) {
        close_both(questions);
        close_both(answers);
        return fail(ErrorCode::load, fmt::format("cannot start a process: {}", std::strerror(errno)));
    }
    if (helper.child_ == 0) {
        ::close(questions[1]);
        ::close(answers[0]);
        be_child(parent, questions[0], answers[1], work);
    }
    ::close(questions[0]);
    ::close(answers[1]);
    helper.question_ = questions[1];
    helper.answer_ = answers[0];
    return helper;
}

ForkedHelper::ForkedHelper(ForkedHelper&& other) noexcept
    : asked_(std::exchange(other.asked_, std::nullopt)), child_(std::exchange(other.child_, -1)),
      question_(std::exchange(other.question_, -1)), answer_(std::exchange(other.answer_, -1)) {}

ForkedHelper::~ForkedHelper() {
    if (child_ == -1)
        return;
    if (question_ != -1)
        ::close(question_);
    ::close(answer_);
    ::kill(child_, SIGKILL);
    status_of(child_);
}

void ForkedHelper::begin(std::string_view question, const ForkedLimits& limits) {
    asked_ = Asked{limits, Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(std::min(limits.seconds, 3e7)))};
    write_line(question_, question);
    ::close(std::exchange(question_, -1));
}

/// Stops the child while `hear` runs.
void ForkedHelper::hear_lines(const Tell& hear) {
    const std::string& output = asked_->result.output;
    size_t& heard = asked_->heard;
    for (size_t end = output.find('\n', heard); end != output.npos; end = output.find('\n', heard)) {
        ::kill(child_, SIGSTOP);
        hear(std::string_view(output).substr(heard, end - heard));
        ::kill(child_, SIGCONT);
        heard = end + 1;
    }
}

/// `ended`: the child ended on its own.
ForkedResult ForkedHelper::finish(bool ended) {
    ForkedResult result = std::move(asked_->result);
    ::close(std::exchange(answer_, -1));
    if (!ended)
        ::kill(child_, SIGKILL);
    const int status = status_of(std::exchange(child_, -1));
    if (!ended || status != 0)
        result.doing = Doing::left_behind();
    if (ended)
        result.crash = crash_of(status, result.doing);
    result.output.resize(result.output.rfind('\n') + 1);
    return result;
}

std::optional<ForkedResult> ForkedHelper::look(const Tell& hear, std::chrono::milliseconds wait) {
    std::array<char, 1 << 14> block;
    pollfd readable{answer_, POLLIN, 0};
    const int ready = ::poll(&readable, 1, int(wait.count()));
    if (ready == 0 && has_to_end(child_, asked_->limits, asked_->deadline, asked_->result))
        return finish(false);
    if (ready <= 0)
        return std::nullopt;
    const ssize_t count = ::read(answer_, block.data(), block.size());
    if (count == 0 || (count < 0 && errno != EINTR))
        return finish(true);
    if (count > 0)
        asked_->result.output.append(block.data(), size_t(count));
    hear_lines(hear);
    return std::nullopt;
}

Result<ForkedResult> ForkedHelper::ask(std::string_view question, const ForkedLimits& limits,
                                       const Tell& hear) {
    begin(question, limits);
    const bool looks = limits.memory > 0 || limits.unwanted;
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(asked_->deadline - Clock::now()).count();
        const std::chrono::milliseconds wait(std::clamp<long>(left, 0, looks ? k_look_ms : 1'000'000));
        if (auto result = look(hear, wait))
            return *std::move(result);
    }
}

Result<ForkedResult> run_forked(const std::function<void(const Tell&)>& work, const ForkedLimits& limits,
                                const Tell& hear) {
    auto helper = ForkedHelper::start([&work](const std::string&, const Tell& tell) { work(tell); });
    if (!helper)
        return fail(std::move(helper.error()));
    return helper->ask({}, limits, hear);
}

} // namespace tidemark::cli
