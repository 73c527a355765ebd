// Reads and writes JSON. Only json_dump.cpp compiles the library's parser and writer, which are its larger
// part.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace tidemark::cli {

using Json = nlohmann::ordered_json;

/// Names and texts may hold any bytes: invalid UTF-8 is replaced.
std::string dump(const Json& json, int indent = -1);

/// Throws Json::exception if `text` is not JSON.
Json parse_json(std::string_view text);

/// Returns a value that `is_discarded()` if `text` is not JSON.
Json parse_or_discard(std::string_view text);

} // namespace tidemark::cli
