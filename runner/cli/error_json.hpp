// Errors as JSON: a process started with run_forked sends its parent one JSON object a line, and an error is
// one of them.
#pragma once

#include "base/error.hpp"
#include "cli/json_dump.hpp"

#include <optional>
#include <string>

namespace tidemark::cli {

Json to_json(const Error& error);
/// Returns nothing if `line` is not an error.
std::optional<Error> error_of(const Json& line);

} // namespace tidemark::cli
