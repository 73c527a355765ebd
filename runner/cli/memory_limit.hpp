// How much memory a process may take: as it is typed, by default, and as much as a process and those that it
// started have taken.
#pragma once

#include "base/result.hpp"

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// What this machine, or the container that it is, has for all its processes; 0: unknown.
uint64_t machine_memory();

/// `512M`, `2G`, `1.5G`, `50%` of `machine`, or bytes; powers of 1024.
Result<uint64_t> parse_memory(std::string_view text, uint64_t machine);

/// `512 MiB`, `11.7 GiB`.
std::string memory_text(uint64_t bytes);

/// The processes that `process` has started and that run, and those that they have started. Takes some tenths
/// of a millisecond.
std::vector<pid_t> descendants_of(pid_t process);

/// What a process has in memory and does not share with a file; takes some microseconds. 0: it is no more.
uint64_t memory_of(pid_t process);

} // namespace tidemark::cli
