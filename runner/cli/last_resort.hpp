// Handles unexpected ends of the process: memory or threads that ran out, or a library's exception that was
// not caught where the library was called. Prints one line on standard error and ends with an exit code,
// without a core dump.
#pragma once

namespace tidemark::cli {

/// The exit code of an internal error: EX_SOFTWARE of sysexits.h.
inline constexpr int k_internal_error = 70;

/// Installs the handler for exceptions that escape on any thread.
void end_by_last_resort();

/// Prints the message for the current exception and returns the exit code. Call it in a catch block of the
/// main thread.
int last_resort();

} // namespace tidemark::cli
