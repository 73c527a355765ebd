// A probe that was asked, with its answer, and its way from the process that asks to the one that reports.
#pragma once

#include "cli/check/trace_apart.hpp"
#include "cli/error_json.hpp"
#include "lab/check/probe.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace tidemark::cli {

struct ProbeResult {
    const lab::Probe* probe;
    lab::Answer answer; ///< its picture does not come along: it is in a file
    double seconds = 0;
    std::filesystem::path picture{}; ///< empty: none was written
    /// The origin of what is not finite, or why that is not known. For people, whole lines; for scripts.
    std::string trace{};
    Json trace_json{};
};

Json to_json(const ProbeResult& asked);
ProbeResult result_of(const Json& line);

} // namespace tidemark::cli
