#include "cli/json_dump.hpp"

#include <nlohmann/json.hpp>

namespace tidemark::cli {

std::string dump(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json parse_json(std::string_view text) {
    return Json::parse(text);
}

Json parse_or_discard(std::string_view text) {
    return Json::parse(text, nullptr, false);
}

} // namespace tidemark::cli
