// A trace of a NaN (lab/trace/nan_trace.hpp) in a process of its own, so that neither a crash of the driver
// nor a shader without end is more than an answer.
#pragma once

#include "cli/error_json.hpp"
#include "lab/trace/nan_trace.hpp"
#include "platform/device_choice.hpp"
#include "scene/scene.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace tidemark::cli {

/// What to trace, and where to draw.
struct TraceJob {
    platform::DeviceChoice device{};
    lab::TraceRequest request;
};

/// The best that was reported until the end.
struct TraceFound {
    bool found = false;  ///< something is not finite
    std::string text{};  ///< for people, whole lines
    Json json{};         ///< for scripts; null where nothing was found
    std::string ended{}; ///< why it did not come to its end; empty: it did
};

/// To be called before this process has a context (cli/forked.hpp). Fails where the scene does not compile,
/// or nothing was found in time.
Result<TraceFound> trace_apart(const scene::Scene& scene, const TraceJob& job, double seconds);

} // namespace tidemark::cli
