// Messages for users on standard error, results on standard output.
#pragma once

#include "base/result.hpp"

#include <cstddef>
#include <span>
#include <string_view>

namespace tidemark::cli {

/// Writes a line to standard error, without characters that would control the terminal (base/printable.hpp).
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

} // namespace tidemark::cli
