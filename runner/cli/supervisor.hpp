// A command in a process of its own, under the eyes of the one that was started: a driver that crashes, or
// that takes all the memory, ends the command with a sentence and an exit code, not with the system's word.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tidemark::cli {

struct Limits {
    uint64_t memory = 0;             ///< of the process and all that it starts, in bytes; 0: none
    std::optional<double> seconds{}; ///< for each thing that a driver is asked to do
};

/// Forks: to be called before there are threads, a driver or anything to tidy up. Comes back empty in the
/// child, which goes on with the command; in the parent with the exit code, once the child has ended. Where
/// no process can be had, the command goes on unsupervised.
///
/// The child is in a process group of its own, so that a signal reaches it once: by way of the parent, which
/// hands on what it gets. It ends with the parent, however that ends.
std::optional<int> supervise(const Limits& limits);

/// "the driver crashed (SIGSEGV) compiling Image of 'a.glsl'"; `doing` may be empty.
std::string crash_text(int signal, const std::string& doing);

/// Whether a process that crashed has that signal, and not one of somebody who wanted it to end.
bool is_crash(int signal);

} // namespace tidemark::cli
