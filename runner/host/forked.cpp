#include "host/forked.hpp"

#include "base/encoding.hpp"
#include "base/supervision.hpp"
#include "host/supervision.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>
#include <utility>

namespace tidemark::host {
namespace {

constexpr uint64_t k_kibi = 1024;

/// Reads up to 4096 bytes of a system file, whose size is not known before it is read.
std::string system_file(const std::string& path) {
    std::array<char, 4096> text{};
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return {};
    const ssize_t count = ::read(file, text.data(), text.size());
    ::close(file);
    return {text.data(), size_t(std::max<ssize_t>(count, 0))};
}

/// Returns the container's memory limit in bytes; the largest value if there is none.
uint64_t limit_of_container() {
    for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
        const std::string text = system_file(file);
        std::string_view rest = text;
        uint64_t limit = 0;
        if (consume_number(rest, limit) && limit > 0)
            return limit;
    }
    return std::numeric_limits<uint64_t>::max();
}

void add_descendants(pid_t process, std::vector<pid_t>& found) {
    const std::string tasks = fmt::format("/proc/{}/task", process);
    DIR* folder = ::opendir(tasks.c_str());
    if (!folder)
        return;
    while (const dirent* task = ::readdir(folder)) {
        if (task->d_name[0] == '.')
            continue;
        const std::string children = system_file(fmt::format("{}/{}/children", tasks, task->d_name));
        std::string_view rest = children;
        for (pid_t child = 0; consume_number(rest, child); consume(rest, ' ')) {
            found.push_back(child);
            add_descendants(child, found);
        }
    }
    ::closedir(folder);
}

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
bool has_to_end(pid_t child, const Limits& limits, Clock::time_point deadline, ForkedResult& result) {
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

uint64_t machine_memory() {
    const long pages = ::sysconf(_SC_PHYS_PAGES);
    const long size = ::sysconf(_SC_PAGESIZE);
    const uint64_t machine = pages > 0 && size > 0 ? uint64_t(pages) * uint64_t(size) : 0;
    return std::min(machine, limit_of_container());
}

Result<uint64_t> parse_memory(std::string_view text, uint64_t machine) {
    double number = 0;
    std::string_view unit = text;
    double factor = 0;
    if (consume_number(unit, number) && std::isfinite(number)) {
        if (unit == "%")
            factor = double(machine) / 100;
        else if (unit.empty())
            factor = 1;
        else if (const size_t power = std::string_view("KMGT").find(unit.front()); power != unit.npos) {
            unit.remove_prefix(1);
            if (unit.empty() || unit == "B" || unit == "iB")
                factor = std::pow(double(k_kibi), double(power + 1));
        }
    }
    const double bytes = number * factor;
    if (!(bytes >= 1) || bytes > 1e18)
        return fail(ErrorCode::usage, fmt::format("--memory {}: give a size as in 512M, 2G or 50%", text));
    return uint64_t(bytes);
}

std::string memory_text(uint64_t bytes) {
    constexpr std::array<const char*, 5> k_units{"bytes", "KiB", "MiB", "GiB", "TiB"};
    auto number = double(bytes);
    size_t unit = 0;
    for (; number >= k_kibi && unit + 1 < k_units.size(); ++unit)
        number /= k_kibi;
    return fmt::format("{:.{}f} {}", number, number < 10 && number != std::floor(number) ? 1 : 0,
                       k_units[unit]);
}

std::vector<pid_t> descendants_of(pid_t process) {
    std::vector<pid_t> found;
    add_descendants(process, found);
    return found;
}

uint64_t memory_of(pid_t process) {
    // Pages: whole address space, resident, and resident pages shared with files.
    const std::string statm = system_file(fmt::format("/proc/{}/statm", process));
    unsigned long long all = 0, resident = 0, shared = 0;
    if (std::sscanf(statm.c_str(), "%llu %llu %llu", &all, &resident, &shared) != 3)
        return 0;
    return (resident - std::min(resident, shared)) * uint64_t(::sysconf(_SC_PAGESIZE));
}

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

void ForkedHelper::begin(std::string_view question, const Limits& limits) {
    constexpr double k_year = 3e7; // above it the clock's integers could overflow
    const std::chrono::duration<double> time(std::min(limits.seconds.value_or(k_year), k_year));
    asked_ = Asked{limits, Clock::now() + std::chrono::duration_cast<Clock::duration>(time)};
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

Result<ForkedResult> ForkedHelper::ask(std::string_view question, const Limits& limits, const Tell& hear) {
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

Result<ForkedResult> run_forked(const std::function<void(const Tell&)>& work, const Limits& limits,
                                const Tell& hear) {
    auto helper = ForkedHelper::start([&work](const std::string&, const Tell& tell) { work(tell); });
    if (!helper)
        return fail(std::move(helper.error()));
    return helper->ask({}, limits, hear);
}

} // namespace tidemark::host
