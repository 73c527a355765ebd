// Where to draw, as people say it: what `--device` and `--require-gpu` give.
#pragma once

#include <string>

namespace tidemark::platform {

struct DeviceChoice {
    std::string name = "auto";
    bool gpu_only = false; ///< no context rather than one that draws on the CPU
};

} // namespace tidemark::platform
