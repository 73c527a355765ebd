// Work in child processes with limits of time and memory, and the measurement of memory.
//
// Memory of processes: parses and formats sizes, and measures the machine's memory and that of a process and
// its descendants.
#pragma once

#include "base/error.hpp"

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::host {

/// Returns the memory of the machine, or the container's limit if that is lower, in bytes; 0: unknown.
uint64_t machine_memory();

/// Parses `512M`, `2G`, `1.5G`, `50%` (of `machine`), or bytes; units are powers of 1024.
Result<uint64_t> parse_memory(std::string_view text, uint64_t machine);

/// Formats a size, for example `512 MiB` or `11.7 GiB`.
std::string memory_text(uint64_t bytes);

/// Returns the running descendants of `process`. Takes some tenths of a millisecond.
std::vector<pid_t> descendants_of(pid_t process);

/// Returns the resident memory of a process that is not shared with files, in bytes; 0 if it has ended. Takes
/// some microseconds.
uint64_t memory_of(pid_t process);

// Runs work in a child process, for work that may crash or never end, such as a driver that compiles a
// hostile shader. Call it before the program has an OpenGL context or threads, apart from an Interrupt's
// thread.

struct ForkedResult {
    std::string output;       ///< all that the work sent, whole lines only
    bool timed_out = false;   ///< ended after `seconds`
    bool over_memory = false; ///< ended because it exceeded the memory limit
    bool unwanted = false;    ///< ended because `unwanted` returned true
    std::string crash{};      ///< how the process crashed, for example in a driver; empty: it ended normally
    std::string doing{}; ///< the driver call in progress, if the process did not end normally; may be empty
};

/// Sends one line to the parent; sent lines survive the end of the work.
using Tell = std::function<void(std::string_view line)>;

/// Limits of work in another process, which end it early.
struct Limits {
    /// Time for all the work; under `supervise` (host/supervision.hpp), for each driver operation.
    std::optional<double> seconds{};
    uint64_t memory = 0; ///< bytes, under `supervise` with all descendants; 0: no limit
    /// Called about twenty times a second by run_forked and ForkedHelper: returns true to end the work.
    std::function<bool()> unwanted{};
};

/// Runs `work` in a child process and waits for it. `hear` is called with each line as it arrives; the child
/// is stopped during that call.
Result<ForkedResult> run_forked(
    const std::function<void(const Tell&)>& work, const Limits& limits,
    const Tell& hear = [](std::string_view) {});

/// A child process that is forked early, while that is safe, and sleeps until `ask`.
class ForkedHelper {
public:
    using Work = std::function<void(const std::string& question, const Tell&)>;
    static Result<ForkedHelper> start(const Work& work);
    ForkedHelper(ForkedHelper&& other) noexcept;
    ForkedHelper& operator=(ForkedHelper&&) = delete;
    /// Kills the child if it still runs, and waits for its end.
    ~ForkedHelper();

    /// Sends the child its one-line question and waits for the result; call it once. `hear` as in run_forked.
    Result<ForkedResult> ask(
        std::string_view question, const Limits& limits, const Tell& hear = [](std::string_view) {});

    /// `ask` in steps, for callers that wait for other things too: call `begin` once, then `look` whenever
    /// `descriptor` is readable or time has passed. `look` waits at most `wait` for output, passes complete
    /// lines to `hear`, and returns the result after the work has ended.
    void begin(std::string_view question, const Limits& limits);
    int descriptor() const { return answer_; }
    std::optional<ForkedResult> look(const Tell& hear, std::chrono::milliseconds wait);

private:
    struct Asked {
        Limits limits;
        std::chrono::steady_clock::time_point deadline;
        ForkedResult result{};
        size_t heard = 0; ///< bytes of its output passed to `hear`
    };

    ForkedHelper() = default;
    void hear_lines(const Tell& hear);
    ForkedResult finish(bool ended);

    std::optional<Asked> asked_{};
    int child_ = -1;    ///< -1: already reaped
    int question_ = -1; ///< writes to the child
    int answer_ = -1;   ///< reads from the child
};

} // namespace tidemark::host
