#include "base/process.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

extern "C" { // glibc 2.36's header lacks it
#include <sys/pidfd.h>
}

namespace tidemark {
namespace {

using Clock = ChildProcess::Clock;

constexpr int k_patience_ms = 60000;
constexpr int k_longest_wait_ms = 1 << 30;
constexpr size_t k_pipe_holds = size_t{1} << 16;
constexpr std::string_view k_too_long = "the program that was started takes too long";

tl::unexpected<Error> cannot_run(const std::string& program, int error_number, std::string_view advice) {
    if (error_number == ENOENT)
        return fail(ErrorCode::load,
                    fmt::format("there is no program '{}'{}{}", program,
                                program.find('/') == program.npos ? " in PATH" : "", advice));
    return fail(ErrorCode::load, fmt::format("cannot run '{}': {}", program, system_reason(error_number)));
}

void close_and_forget(int& fd) {
    if (fd >= 0)
        ::close(std::exchange(fd, -1));
}

/// A pipe's two ends, the reading one first, of which `our_end` does not block. The destructor closes them.
struct Pipe {
    std::array<int, 2> ends = {-1, -1};

    explicit Pipe(int our_end) {
        if (::pipe2(ends.data(), O_CLOEXEC) == 0)
            ::fcntl(ends[size_t(our_end)], F_SETFL, O_NONBLOCK);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close_and_forget(ends[0]);
        close_and_forget(ends[1]);
    }
    bool good() const { return ends[0] >= 0; }
};

/// File actions and attributes for posix_spawn: standard streams, no other descriptors, default signals and
/// an own process group.
class SpawnPlan {
public:
    SpawnPlan(ChildProcess::Input kind, int input, int output, int words) {
        ::posix_spawn_file_actions_init(&actions_);
        if (kind == ChildProcess::Input::written)
            ::posix_spawn_file_actions_adddup2(&actions_, input, 0);
        else
            ::posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_adddup2(&actions_, output, 1);
        ::posix_spawn_file_actions_adddup2(&actions_, words, 2);
        ::posix_spawn_file_actions_addclosefrom_np(&actions_, 3);
        ::posix_spawnattr_init(&attributes_);
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        ::posix_spawnattr_setsigmask(&attributes_, &none);
        ::posix_spawnattr_setsigdefault(&attributes_, &all);
        ::posix_spawnattr_setpgroup(&attributes_, 0);
        ::posix_spawnattr_setflags(&attributes_,
                                   POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;
    ~SpawnPlan() {
        ::posix_spawnattr_destroy(&attributes_);
        ::posix_spawn_file_actions_destroy(&actions_);
    }
    const posix_spawn_file_actions_t* actions() const { return &actions_; }
    const posix_spawnattr_t* attributes() const { return &attributes_; }

private:
    posix_spawn_file_actions_t actions_;
    posix_spawnattr_t attributes_;
};

/// Calls read() again after EINTR; returns -1 with EAGAIN while data is missing.
ssize_t read_some(int fd, void* to, size_t size) {
    ssize_t count;
    do
        count = ::read(fd, to, size);
    while (count < 0 && errno == EINTR);
    return count;
}

/// Returns poll()'s timeout in milliseconds: the time left; one minute without a deadline.
int wait_ms(Clock::time_point until) {
    if (until == Clock::time_point::max())
        return k_patience_ms;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    return int(std::clamp<int64_t>(left, 0, k_longest_wait_ms));
}

} // namespace

Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& arguments, Input kind,
                                         std::string_view advice) {
    Pipe input(1), output(0), words(0);
    if (!input.good() || !output.good() || !words.good())
        return cannot_run(arguments[0], errno, advice);
    const std::vector<char*> argv = argument_pointers(arguments);
    const SpawnPlan plan(kind, input.ends[0], output.ends[1], words.ends[1]);
    ChildProcess child;
    const int error =
        ::posix_spawnp(&child.process_, argv[0], plan.actions(), plan.attributes(), argv.data(), environ);
    if (error != 0) {
        child.process_ = -1;
        return cannot_run(arguments[0], error, advice);
    }
    child.leftover_ = Leftover::child(child.process_);
    if (kind == Input::written)
        child.input_ = std::exchange(input.ends[1], -1);
    child.output_ = std::exchange(output.ends[0], -1);
    child.words_ = std::exchange(words.ends[0], -1);
    return child;
}

void ChildProcess::close_input() {
    close_and_forget(input_);
}

void ChildProcess::close_pipes() {
    close_input();
    close_and_forget(output_);
    close_and_forget(words_);
}

ChildProcess::~ChildProcess() {
    close_pipes();
    if (process_ <= 0)
        return;
    leftover_.forget(); // the system may soon reuse its number
    ::kill(-process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void ChildProcess::read_words(std::string& words) {
    if (words.size() > most_words_)
        words.erase(0, words.size() - most_words_);
    std::array<char, 4096> block;
    // At most a pipe's capacity, so that a child that writes without end cannot hold the caller here.
    for (size_t left = k_pipe_holds; words_ >= 0 && left > 0; left -= block.size()) {
        const ssize_t count = read_some(words_, block.data(), block.size());
        if (count > 0)
            words.append(block.data(), size_t(count));
        else if (count < 0 && errno == EAGAIN)
            return;
        else
            close_and_forget(words_);
    }
}

bool ChildProcess::write(std::span<const std::byte> bytes, std::string& words) {
    while (!bytes.empty() && input_ >= 0) {
        read_words(words);
        const ssize_t count = ::write(input_, bytes.data(), bytes.size());
        if (count > 0) {
            bytes = bytes.subspan(size_t(count));
        } else if (count < 0 && errno == EAGAIN) {
            std::array<pollfd, 2> wait = {{{input_, POLLOUT, 0}, {words_, POLLIN, 0}}};
            if (::poll(wait.data(), wait.size(), k_patience_ms) == 0)
                break;
        } else if (count == 0 || errno != EINTR) {
            break;
        }
    }
    return bytes.empty();
}

Result<size_t> ChildProcess::read(std::span<std::byte> to, std::string& words, Clock::time_point until) {
    while (output_ >= 0) {
        if (Clock::now() >= until)
            return fail(ErrorCode::timed_out, std::string(k_too_long));
        read_words(words);
        const ssize_t count = read_some(output_, to.data(), to.size());
        if (count > 0)
            return size_t(count);
        if (count == 0 || errno != EAGAIN) {
            close_and_forget(output_);
            break;
        }
        std::array<pollfd, 2> wait = {{{output_, POLLIN, 0}, {words_, POLLIN, 0}}};
        const int ready = ::poll(wait.data(), wait.size(), wait_ms(until));
        if (ready == 0 && until == Clock::time_point::max())
            return fail(ErrorCode::load, "the program that was started printed nothing for a minute");
    }
    read_words(words);
    return size_t{0};
}

bool ChildProcess::read_output(std::string& to) {
    std::array<char, 4096> block;
    for (size_t left = k_pipe_holds; output_ >= 0 && left > 0; left -= block.size()) {
        const ssize_t count = read_some(output_, block.data(), block.size());
        if (count > 0)
            to.append(block.data(), size_t(count));
        else if (count < 0 && errno == EAGAIN)
            return true;
        else
            close_and_forget(output_);
    }
    return output_ >= 0;
}

size_t ChildProcess::write_some(std::string_view bytes) {
    if (input_ < 0)
        return 0;
    const ssize_t count = ::write(input_, bytes.data(), bytes.size());
    if (count < 0 && errno != EAGAIN && errno != EINTR)
        close_input();
    return size_t(std::max(count, ssize_t{0}));
}

void ChildProcess::terminate() {
    if (process_ > 0)
        ::kill(process_, SIGTERM);
}

bool ChildProcess::ends_before(Clock::time_point until) const {
    const Descriptor process(::pidfd_open(process_, 0));
    pollfd ended = {process.get(), POLLIN, 0};
    int ready;
    do
        ready = ::poll(&ended, 1, wait_ms(until));
    while (ready < 0 && errno == EINTR);
    return ready != 0;
}

void ChildProcess::stop() {
    if (process_ > 0)
        ::kill(process_, SIGKILL);
}

bool ChildProcess::succeeded() {
    close_pipes();
    int status = -1;
    if (process_ <= 0)
        return false;
    leftover_.forget();
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Result<std::string> output_of(const std::vector<std::string>& arguments, const OutputLimits& limits,
                              std::string_view advice) {
    ChildProcess child = TRY(ChildProcess::start(arguments, ChildProcess::Input::none, advice));
    child.most_words_ = k_pipe_holds;
    std::string output, words;
    std::array<std::byte, 1 << 14> block;
    while (const size_t count = TRY(child.read(block, words, limits.until))) {
        output.append(reinterpret_cast<const char*>(block.data()), count);
        if (output.size() > limits.bytes)
            return fail(ErrorCode::load,
                        fmt::format("'{}' prints more than {} MiB", arguments[0], limits.bytes >> 20));
    }
    if (limits.until != Clock::time_point::max() && !child.ends_before(limits.until))
        return fail(ErrorCode::timed_out, std::string(k_too_long));
    if (!child.succeeded())
        return fail(ErrorCode::load, last_line(std::move(words)));
    return output;
}

} // namespace tidemark
