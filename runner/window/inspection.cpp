#include "window/inspection.hpp"

#include "base/process.hpp"
#include "host/console.hpp"
#include "host/json.hpp"
#include "host/scene_report.hpp"
#include "window/screen.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <utility>

namespace tidemark::window {

using namespace host;
namespace {

constexpr double k_shortest_pause_seconds = 1;
/// Limits the checks to 1 % of the time.
constexpr double k_pause_per_second_of_looking = 100;

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

std::vector<render::PassTimer>* PassCosts::next_frame() {
    frame_before_ = std::exchange(in_parts_, std::nullopt);
    for (const render::PassTimer& timer : timers_)
        if (const auto took = timer.time.milliseconds(); took) {
            milliseconds_[timer.pass] = *took;
            frame_before_ = frame_before_.value_or(0) + *took;
        }
    timers_.clear();
    return &timers_;
}

void PassCosts::took(size_t pass, double milliseconds) {
    milliseconds_[pass] = milliseconds;
    in_parts_ = in_parts_.value_or(0) + milliseconds;
}

void PassCosts::forget() {
    in_parts_.reset();
    timers_.clear();
    milliseconds_.clear();
    frame_before_.reset();
}

std::optional<double> PassCosts::of(size_t pass) const {
    const auto known = milliseconds_.find(pass);
    return known == milliseconds_.end() ? std::nullopt : std::optional(known->second);
}

void FiniteWatch::begin_anew() {
    *this = {};
}

double FiniteWatch::due() const {
    return unseen_ && found_ == 0 ? next_ : std::numeric_limits<double>::infinity();
}

size_t FiniteWatch::look(const render::Renderer& renderer, double now) {
    image::Image picture = renderer.read_back();
    found_ = count_not_finite(renderer, picture);
    unseen_ = false;
    next_ = now + std::max(k_shortest_pause_seconds, k_pause_per_second_of_looking * (now_seconds() - now));
    return found_;
}

Error origin_of(const std::string& json) {
    const auto report = parse_or_discard(json);
    if (!report.is_object())
        return {ErrorCode::check_failed, "the trace ended without a result: run check --trace to see why"};
    if (const auto ended = report.value("ended", ""); !ended.empty())
        return {ErrorCode::check_failed, "no origin was found: " + ended};
    const auto trace = report.value("trace", Json());
    if (!trace.is_object())
        return {ErrorCode::check_failed, "no origin was found: drawn again, the pixel is finite"};
    const auto fix = trace.value("fix", Json());
    const auto origin = fix.is_object() ? fix : trace.value("first", Json());
    if (!origin.is_object())
        return {ErrorCode::check_failed, "no operation of the shown pass made it: it was read from an input"};
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

} // namespace tidemark::window
