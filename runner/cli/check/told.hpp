// What a process of run_forked tells its parent: one JSON object a line. An error is one, too.
#pragma once

#include "base/error.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace tidemark::cli {

using Json = nlohmann::ordered_json;

/// Texts of shaders may hold any bytes: what is no UTF-8 is replaced.
std::string dump(const Json& json, int indent = -1);

Json told(const Error& error);
/// Nothing when `line` is no error.
std::optional<Error> told_error(const Json& line);

} // namespace tidemark::cli
