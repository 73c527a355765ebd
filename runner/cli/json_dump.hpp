// JSON on its way in and out of the program. The library's parser and writer are compiled here alone: they
// are the larger part of it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace tidemark::cli {

using Json = nlohmann::ordered_json;

/// Names and texts may hold any bytes: what is no UTF-8 is replaced.
std::string dump(const Json& json, int indent = -1);

/// Throws Json::exception where `text` is no JSON.
Json parse_json(std::string_view text);

/// Returns a value that `is_discarded()` where `text` is no JSON.
Json parse_or_discard(std::string_view text);

} // namespace tidemark::cli
