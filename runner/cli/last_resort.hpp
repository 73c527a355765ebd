// The end of a process that nobody foresaw: memory or threads that ran out, a library's exception that was
// not caught where the library was called. One line on standard error and an exit code; no core.
#pragma once

namespace tidemark::cli {

/// The exit code of a defect of ours: EX_SOFTWARE of sysexits.h.
inline constexpr int k_internal_error = 70;

/// For what escapes on any thread.
void end_by_last_resort();

/// In a handler of the main thread's exceptions: the line is said, the exit code returned.
int last_resort();

} // namespace tidemark::cli
