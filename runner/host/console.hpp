// Messages for users on standard error, results on standard output.
#pragma once

#include "base/error.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>

namespace tidemark::host {

/// The version of the program, from CMake's project().
extern const char* const k_version;

/// Writes a line to standard error, without characters that would control the terminal (base/encoding.hpp).
/// A closed standard error is not an error.
void say(std::string_view line);
/// Writes like `say`, also after `keep_words_back`.
void say_to_programs(std::string_view line);
/// Reserves standard error for output that programs read: `say` prints nothing from now on.
void keep_words_back();

/// Writes results to standard output and flushes them. Fails (ErrorCode::write) if they cannot be written.
/// Text is made printable as in `say`, since it may go to a terminal; in JSON an escaped character is the
/// same character.
Result<void> put(std::string_view text);
Result<void> put(std::span<const std::byte> bytes);
/// Writes text unchanged to a pipe or a file, and printable to a terminal.
Result<void> put_exact(std::string_view text);

// Progress of a long command on standard error: one line that is overwritten on a terminal, otherwise a line
// for each tenth. Nothing is shown in the first seconds.

class Progress {
public:
    struct Manner {
        double silent = 2;   ///< seconds before the first line
        double between = 10; ///< seconds after which a line is due even within a tenth
        /// Set where pieces take unpredictable time: no rate is computed, only the time left until the latest
        /// end is shown. Seconds from the start.
        std::optional<double> limit{};
    };
    /// `what` is the unit that is counted, for example "frames".
    Progress(std::string what, size_t total, Manner manner);
    Progress(std::string what, size_t total) : Progress(std::move(what), total, Manner()) {}
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance();
    /// Clears the line on a terminal, so that other output can be printed.
    void step_aside();

private:
    std::string line() const;

    std::string what_;
    size_t total_;
    Manner manner_;
    size_t done_ = 0;
    bool on_terminal_ = false; ///< a line is shown
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
    std::chrono::steady_clock::time_point first_done_;
};

/// Says what a long call does, for calls that report no progress: prints `message` once, if it still exists
/// after `delay`.
class SlowNotice {
public:
    explicit SlowNotice(std::string message, std::chrono::milliseconds delay = std::chrono::seconds(2));

private:
    std::jthread thread_;
};

} // namespace tidemark::host
