// A trace as people and as scripts read it.
#pragma once

#include "lab/trace/nan_trace.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace tidemark::cli {

std::string to_text(const lab::NanTrace& trace);
nlohmann::ordered_json to_json(const lab::NanTrace& trace);

/// Where such a JSON says that the first operation stands; nothing where it names none, or none of a file.
std::optional<SourceLocation> origin_in(const nlohmann::ordered_json& trace);

} // namespace tidemark::cli
