// What a device can be trusted with, a question each: what it draws is held against IEEE 754, the precision
// that Vulkan asks of GLSL's functions, and itself. A context must be current; nothing is read but our own
// small texts.
#pragma once

#include "base/result.hpp"
#include "lab/check/probe.hpp"

#include <span>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// `warn`: scenes may look otherwise here than on other devices. `fail`: numbers of ours would be wrong.
struct DeviceAnswer {
    Verdict verdict = Verdict::pass;
    std::string sentence;
};

struct DeviceCheck {
    std::string_view name;
    Result<DeviceAnswer> (*ask)();
};

/// In the order they are asked: the cheap ones first.
std::span<const DeviceCheck> device_checks();

} // namespace tidemark::lab
