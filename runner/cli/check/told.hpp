// What a process of run_forked tells its parent: one JSON object a line. An error is one, too.
#pragma once

#include "base/error.hpp"
#include "cli/json_dump.hpp"

#include <optional>
#include <string>

namespace tidemark::cli {

Json told(const Error& error);
/// Nothing when `line` is no error.
std::optional<Error> told_error(const Json& line);

} // namespace tidemark::cli
