#include "cli/view/origin_search.hpp"

#include "base/argument_pointers.hpp"
#include "cli/json_dump.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace tidemark::cli {
namespace {

constexpr const char* k_this_program = "/proc/self/exe";

/// Starts this program with its standard output connected to `pipe`. Returns 0 or an errno value.
int spawn(const std::vector<std::string>& words, int pipe, pid_t& child) {
    const std::vector<char*> arguments = argument_pointers(words);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, pipe, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = ::posix_spawn(&child, k_this_program, &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

std::string read_all(int pipe) {
    std::string text;
    std::array<char, 4096> piece{};
    for (ssize_t count = 0; (count = ::read(pipe, piece.data(), piece.size())) != 0;) {
        if (count > 0)
            text.append(piece.data(), size_t(count));
        else if (errno != EINTR)
            break;
    }
    return text;
}

} // namespace

Error origin_of(const std::string& json) {
    const auto report = parse_or_discard(json);
    if (!report.is_object())
        return {ErrorCode::check_failed, "the trace ended without an answer: run check --trace to see why"};
    if (const auto ended = report.value("ended", ""); !ended.empty())
        return {ErrorCode::check_failed, "no origin was found: " + ended};
    const auto trace = report.value("trace", Json());
    if (!trace.is_object())
        return {ErrorCode::check_failed, "no origin was found: drawn again, the pixel is finite"};
    const auto fix = trace.value("fix", Json());
    const auto origin = fix.is_object() ? fix : trace.value("first", Json());
    if (!origin.is_object())
        return {ErrorCode::check_failed, "no operation of the shown pass gave it: it was read from an input"};
    Error error{ErrorCode::check_failed, ""};
    error.diagnostics.push_back(
        {{origin.value("file", ""), origin.value("line", 0), origin.value("column", 0)},
         Severity::error,
         fmt::format("`{}` gave {}: {}", origin.value("statement", ""), origin.value("value", ""),
                     origin.value("reason", ""))});
    return error;
}

Result<std::unique_ptr<OriginSearch>> OriginSearch::start(const std::vector<std::string>& words,
                                                          std::function<void()> wake) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        return fail(ErrorCode::write, fmt::format("cannot start the trace: {}", std::strerror(errno)));
    pid_t child = 0;
    const int error = spawn(words, ends[1], child);
    ::close(ends[1]);
    if (error != 0) {
        ::close(ends[0]);
        return fail(ErrorCode::write, fmt::format("cannot start the trace: {}", std::strerror(error)));
    }
    return std::unique_ptr<OriginSearch>(new OriginSearch(child, ends[0], std::move(wake)));
}

OriginSearch::OriginSearch(int process, int pipe, std::function<void()> wake)
    : process_(process), reader_([this, pipe, wake = std::move(wake)] {
          printed_ = read_all(pipe);
          ::close(pipe);
          done_ = true;
          wake();
      }) {}

OriginSearch::~OriginSearch() {
    ::kill(process_, SIGKILL); // its children end with it
    reader_.join();
    ::waitpid(process_, nullptr, 0);
}

std::optional<std::string> OriginSearch::take() {
    return done_ ? std::optional(std::move(printed_)) : std::nullopt;
}

} // namespace tidemark::cli
