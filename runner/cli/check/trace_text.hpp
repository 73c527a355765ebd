// A trace as people and as scripts read it.
#pragma once

#include "lab/trace/nan_trace.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tidemark::cli {

std::string to_text(const lab::NanTrace& trace);
nlohmann::ordered_json to_json(const lab::NanTrace& trace);

} // namespace tidemark::cli
