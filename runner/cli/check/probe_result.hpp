// The result of one probe, and its JSON form, by which the child process sends it to its parent.
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
    lab::Answer answer; ///< without its picture, which is in a file
    double seconds = 0;
    std::filesystem::path picture{}; ///< empty: no picture was written
    /// The origin of a NaN or infinity, or why it is unknown: as text with whole lines, and as JSON.
    std::string trace{};
    Json trace_json{};
};

Json to_json(const ProbeResult& asked);
ProbeResult result_of(const Json& line);

} // namespace tidemark::cli
