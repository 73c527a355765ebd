// Formats the result of `tidemark trace` as text and as JSON.
#pragma once

#include "base/extent.hpp"
#include "cli/json_dump.hpp"
#include "lab/pixel/pixel_trace.hpp"

#include <string>

namespace tidemark::cli {

struct TraceReport {
    std::string scene{};
    std::string pass{};
    int frame = 0;
    Extent extent{};
    lab::PixelRequest request{};
    lab::PixelTrace trace{};
};

std::string trace_text(const TraceReport& report);
Json trace_json(const TraceReport& report);

} // namespace tidemark::cli
