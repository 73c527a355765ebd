// Memory of processes: parses and formats sizes, and measures the machine's memory and that of a process and
// its descendants.
#pragma once

#include "base/result.hpp"

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

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

} // namespace tidemark::cli
