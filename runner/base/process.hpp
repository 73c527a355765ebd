// Child processes: argument vectors, and pipes to a running program.
//
// argv for exec and posix_spawn. The pointers are valid while the strings live.
#pragma once

#include "base/error.hpp"
#include "base/supervision.hpp"

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark {

/// Returns the strings' pointers and a null at the end. The system does not write to them, although its
/// interface takes `char*`.
inline std::vector<char*> argument_pointers(const std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (const std::string& word : words)
        pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    return pointers;
}

// Runs another program and exchanges bytes with its standard streams. Uses no shell; no child outlives its
// object.

struct OutputLimits {
    size_t bytes;
    std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
};

/// A program that was started. Its standard output and error are read here; its standard input is empty, or
/// written here. It has a process group of its own, so that Ctrl-C in the terminal does not cut off its
/// output.
class ChildProcess {
public:
    enum class Input { none, written };
    using Clock = std::chrono::steady_clock;

    /// Starts the program of that name in PATH. ErrorCode::load names the program; `advice` says what to do
    /// if there is none.
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
    /// Kills the child's process group if the child has not been waited for, and reaps the child.
    ~ChildProcess();

    /// Waits for standard output and returns the number of bytes read, 0 at the end. Appends standard error
    /// that comes meanwhile to `words`. Fails with ErrorCode::timed_out at `until`; without a deadline, with
    /// ErrorCode::load after a minute of silence.
    Result<size_t> read(std::span<std::byte> to, std::string& words,
                        Clock::time_point until = Clock::time_point::max());

    /// Waits until the child has taken all bytes. Returns false if it takes no more: it has ended, or has
    /// done nothing for a minute. Appends standard error to `words`. SIGPIPE must be ignored.
    bool write(std::span<const std::byte> bytes, std::string& words);
    /// Closes the child's standard input.
    void close_input();

    // For callers that wait for several children at once and must not wait for one.

    /// The descriptors here of the child's standard streams, to be polled; -1: closed.
    struct Streams {
        int input, output, words;
    };
    Streams streams() const { return {input_, output_, words_}; }
    /// Appends the standard output received so far; returns false after its end.
    bool read_output(std::string& to);
    /// Returns the number of bytes that the child's standard input takes now; closes it if it takes no more.
    size_t write_some(std::string_view bytes);
    /// Asks the child to end (SIGTERM).
    void terminate();

    /// Appends the standard error received so far; does not wait.
    void read_words(std::string& words);

    /// Waits until the child ends; returns false if `until` comes first.
    bool ends_before(Clock::time_point until) const;
    /// Kills the child, which also ends a `read` in another thread.
    void stop();

    /// Waits for the child to end; to be called after the end of its output. Returns whether its exit status
    /// is 0.
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
    size_t most_words_ = std::string::npos; ///< limit in bytes; the oldest text is dropped first
    Leftover leftover_;
};

/// Runs a program and returns its standard output. Fails beyond `limits`, or if the program fails: the
/// message is the last line of its standard error, which may be empty. `advice` as for `start`.
Result<std::string> output_of(const std::vector<std::string>& arguments, const OutputLimits& limits,
                              std::string_view advice);

} // namespace tidemark
