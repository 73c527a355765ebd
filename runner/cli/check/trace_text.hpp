// Formats the trace of a NaN as text and as JSON.
#pragma once

#include "lab/trace/nan_trace.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace tidemark::cli {

std::string to_text(const lab::NanTrace& trace);
nlohmann::ordered_json to_json(const lab::NanTrace& trace);

/// Returns the place of the first operation in the JSON of a trace; nothing if there is none, or if it is not
/// in a file.
std::optional<SourceLocation> origin_in(const nlohmann::ordered_json& trace);

} // namespace tidemark::cli
