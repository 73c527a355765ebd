// Another program, run for what it prints or for what it makes of what it is told. No shell is in between; no
// child outlives its object.
#pragma once

#include "base/leftovers.hpp"
#include "base/result.hpp"

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark {

struct OutputLimits {
    size_t bytes;
    std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
};

/// The child's standard output and error are read here; its standard input is empty, or written here. It is
/// in a process group of its own, so that Ctrl-C in the terminal does not cut off its output.
class ChildProcess {
public:
    enum class Input { none, written };
    using Clock = std::chrono::steady_clock;

    /// Runs the program of that name in PATH. ErrorCode::load names the program; `advice` is what to do where
    /// there is none.
    static Result<ChildProcess> start(const std::vector<std::string>& arguments, Input input,
                                      std::string_view advice);

    ChildProcess(ChildProcess&& other) noexcept
        : process_(std::exchange(other.process_, -1)), input_(std::exchange(other.input_, -1)),
          output_(std::exchange(other.output_, -1)), words_(std::exchange(other.words_, -1)),
          most_words_(other.most_words_), leftover_(std::move(other.leftover_)) {}
    ChildProcess& operator=(ChildProcess&& other) noexcept {
        std::swap(process_, other.process_);
        std::swap(input_, other.input_);
        std::swap(output_, other.output_);
        std::swap(words_, other.words_);
        std::swap(most_words_, other.most_words_);
        std::swap(leftover_, other.leftover_);
        return *this;
    }
    /// Kills the child, and what it started, if it still runs, and reaps it.
    ~ChildProcess();

    /// Waits for bytes of standard output and gives their number, 0 at the end. What comes on standard error
    /// in the meantime is appended to `words`. Fails (ErrorCode::timed_out) at `until`; where none is given,
    /// when the child is silent for a minute.
    Result<size_t> read(std::span<std::byte> to, std::string& words,
                        Clock::time_point until = Clock::time_point::max());

    /// Waits until the child has taken all bytes. False when it takes no more of them: it has ended, or does
    /// nothing for a minute. SIGPIPE must be ignored. What comes on standard error is appended to `words`.
    bool write(std::span<const std::byte> bytes, std::string& words);
    /// The end of its standard input.
    void close_input();

    /// Appends what standard error has now; does not wait.
    void read_words(std::string& words);

    /// Whether it ends before then; waits for that.
    bool ends_before(Clock::time_point until) const;
    /// Ends it, and with it a `read` that another thread waits in.
    void stop();

    /// After the end of its output: waits for it. True when it ended with status 0.
    bool succeeded();

private:
    friend Result<std::string> output_of(const std::vector<std::string>&, const OutputLimits&,
                                         std::string_view);
    ChildProcess() = default;
    void close_pipes();

    pid_t process_ = -1;
    int input_ = -1;
    int output_ = -1;
    int words_ = -1;
    size_t most_words_ = std::string::npos; ///< bytes; beyond, the oldest are forgotten
    Leftover leftover_;
};

/// All that a program prints on standard output. Fails when it fails: the message is the last line of its
/// standard error, which may be empty. `advice` as for `start`.
Result<std::string> output_of(const std::vector<std::string>& arguments, const OutputLimits& limits,
                              std::string_view advice);

} // namespace tidemark
