// `tidemark check --trace`: names the statement where a NaN or an infinity has its origin.
#pragma once

#include "cli/options.hpp"
#include "platform/device_choice.hpp"

#include <string>

namespace tidemark::cli {

struct TraceOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string pixel; ///< `x,y`; empty: the first bad one
    platform::DeviceChoice device{};
    double timeout = 60;
    bool hidden = false;
    bool json = false;
};

/// Exit code 1 when something that is not finite was found.
Result<int> check_trace(const TraceOptions& options);

} // namespace tidemark::cli
