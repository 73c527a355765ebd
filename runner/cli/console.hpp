// What people and scripts read: words for people on standard error, results on standard output.
#pragma once

#include "base/result.hpp"

#include <cstddef>
#include <span>
#include <string_view>

namespace tidemark::cli {

/// A line for people, with nothing in it that would steer their terminal (base/printable.hpp). A closed
/// standard error is not an error.
void say(std::string_view line);
/// The same, also behind `keep_words_back`.
void say_to_programs(std::string_view line);
/// From here on standard error is for programs, and `say` is silent.
void keep_words_back();

/// Results, flushed. Fails (ErrorCode::write) when nobody can receive them. Text is made printable as in
/// `say`: people read it, too, and in JSON the escape of a character is the character.
Result<void> put(std::string_view text);
Result<void> put(std::span<const std::byte> bytes);
/// Text that is to go through a pipe as it is; to a terminal it goes like all others.
Result<void> put_exact(std::string_view text);

} // namespace tidemark::cli
