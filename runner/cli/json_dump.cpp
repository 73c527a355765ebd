#include "cli/json_dump.hpp"

namespace tidemark::cli {

std::string dump(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace tidemark::cli
