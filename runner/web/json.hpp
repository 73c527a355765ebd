// JSON for a page's scripts, with members in the order in which they were written.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace tidemark::web {

using Json = nlohmann::ordered_json;

} // namespace tidemark::web
