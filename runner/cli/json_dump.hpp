// JSON as it leaves the program.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace tidemark::cli {

using Json = nlohmann::ordered_json;

/// Names and texts may hold any bytes: what is no UTF-8 is replaced.
std::string dump(const Json& json, int indent = -1);

} // namespace tidemark::cli
