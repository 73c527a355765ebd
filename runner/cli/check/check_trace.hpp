// `tidemark check --trace`: names the statement where a NaN or an infinity originates.
#pragma once

#include "cli/options.hpp"
#include "platform/device_choice.hpp"

#include <string>

namespace tidemark::cli {

struct TraceOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string pixel; ///< `x,y`; empty: the first pixel that is not finite
    platform::DeviceChoice device{};
    double timeout = 60;
    bool hidden = false;
    bool json = false;
};

/// Returns exit code 1 if something not finite was found.
Result<int> check_trace(const TraceOptions& options);

} // namespace tidemark::cli
