// The user's choice of a device, from `--device` and `--require-gpu`.
#pragma once

#include <string>

namespace tidemark::platform {

struct DeviceChoice {
    std::string name = "auto";
    bool gpu_only = false; ///< fail rather than draw on the CPU
};

} // namespace tidemark::platform
