// Runs the command in a supervised child process: if a driver crashes or takes too much memory, the command
// ends with a message and an exit code instead of a bare signal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tidemark::cli {

struct Limits {
    uint64_t memory = 0;             ///< of the process and its descendants, in bytes; 0: no limit
    std::optional<double> seconds{}; ///< for each driver operation, for example a compile
};

/// Forks; call it before there are threads, a driver or anything to clean up. Returns nothing in the child,
/// which goes on with the command; in the parent it returns the exit code once the child has ended. If fork
/// fails, the command goes on unsupervised.
///
/// The child has its own process group, so that a signal reaches it once, passed on by the parent. It is
/// killed if the parent ends, however the parent ends.
std::optional<int> supervise(const Limits& limits);

/// Returns for example "the driver crashed (SIGSEGV) compiling Image of 'a.glsl'"; `doing` may be empty.
std::string crash_text(int signal, const std::string& doing);

/// Returns true for signals of a crash, not for requests to end.
bool is_crash(int signal);

} // namespace tidemark::cli
