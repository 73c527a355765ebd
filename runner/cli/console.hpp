// What people and scripts read: words for people on standard error, results on standard output.
#pragma once

#include "base/result.hpp"

#include <cstddef>
#include <span>
#include <string_view>

namespace tidemark::cli {

/// A line for people. A closed standard error is not an error.
void say(std::string_view line);

/// Results for scripts, flushed. Fails (ErrorCode::write) when nobody can receive them.
Result<void> put(std::string_view text);
Result<void> put(std::span<const std::byte> bytes);

} // namespace tidemark::cli
