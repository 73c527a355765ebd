// Traces a NaN (lab/trace/nan_trace.hpp) in a child process, so that a crash of the driver or an endless
// shader is only an error.
#pragma once

#include "cli/error_json.hpp"
#include "lab/trace/nan_trace.hpp"
#include "platform/device_choice.hpp"
#include "scene/scene.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace tidemark::cli {

/// The pixel or frame to trace, and the device to draw on.
struct TraceJob {
    platform::DeviceChoice device{};
    lab::TraceRequest request;
};

/// The best result reported before the end.
struct TraceFound {
    bool found = false;  ///< something is NaN or infinite
    std::string text{};  ///< report as text, whole lines
    Json json{};         ///< report as JSON; null if nothing was found
    std::string ended{}; ///< why the trace is incomplete; empty: it is complete
};

/// Traces in a child process; call it before this process has a context (cli/forked.hpp). Fails if the scene
/// does not compile, or if nothing was found in time.
Result<TraceFound> trace_apart(const scene::Scene& scene, const TraceJob& job, double seconds);

} // namespace tidemark::cli
