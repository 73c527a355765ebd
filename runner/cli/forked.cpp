#include "cli/forked.hpp"

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

namespace tidemark::cli {
namespace {

using Clock = std::chrono::steady_clock;

void write_line(int fd, std::string_view line) {
    std::string text(line);
    text += '\n';
    for (size_t written = 0; written < text.size();) {
        const ssize_t count = ::write(fd, text.data() + written, text.size() - written);
        if (count < 0 && errno != EINTR)
            return; // the parent is gone
        written += count > 0 ? size_t(count) : 0;
    }
}

[[noreturn]] void be_child(int fd, const std::function<void(const Tell&)>& work) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL); // Ctrl-C at the parent ends us too
    work([fd](std::string_view line) { write_line(fd, line); });
    ::_exit(0); // no destructors of a driver that may hang in them
}

/// Reads to the end or the deadline. True: the end.
bool read_all(int fd, Clock::time_point deadline, std::string& output) {
    std::array<char, 1 << 14> block;
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd wait{fd, POLLIN, 0};
        const int ready = left <= 0 ? 0 : ::poll(&wait, 1, int(std::min<long>(left, 1'000'000)));
        if (ready == 0 && Clock::now() >= deadline)
            return false;
        if (ready <= 0)
            continue;
        const ssize_t count = ::read(fd, block.data(), block.size());
        if (count == 0 || (count < 0 && errno != EINTR))
            return true;
        if (count > 0)
            output.append(block.data(), size_t(count));
    }
}

} // namespace

Result<ForkedResult> run_forked(const std::function<void(const Tell&)>& work, double seconds) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        return fail(ErrorCode::load, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    const pid_t child = ::fork();
    if (child < 0) {
        ::close(ends[0]);
        ::close(ends[1]);
        return fail(ErrorCode::load, fmt::format("cannot start a process: {}", std::strerror(errno)));
    }
    if (child == 0) {
        ::close(ends[0]);
        be_child(ends[1], work);
    }
    ::close(ends[1]);
    ForkedResult result;
    const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                             std::chrono::duration<double>(std::min(seconds, 3e7)));
    result.timed_out = !read_all(ends[0], deadline, result.output);
    ::close(ends[0]);
    if (result.timed_out)
        ::kill(child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!result.timed_out && WIFSIGNALED(status))
        result.signal = WTERMSIG(status);
    result.output.resize(result.output.rfind('\n') + 1);
    return result;
}

} // namespace tidemark::cli
