// Checks of a GPU and its driver: compares what they draw with IEEE 754, with the precision that Vulkan
// requires of GLSL's functions, and with other drawings. It draws only small texts of its own. A context must
// be current.
#pragma once

#include "base/result.hpp"
#include "lab/check/probe.hpp"

#include <span>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// `warn`: scenes may look different from other devices. `fail`: Tidemark's numbers would be wrong.
struct DeviceAnswer {
    Verdict verdict = Verdict::pass;
    std::string sentence;
};

struct DeviceCheck {
    std::string_view name;
    Result<DeviceAnswer> (*ask)();
};

/// Returns all checks in the order in which they run: the cheap ones first.
std::span<const DeviceCheck> device_checks();

} // namespace tidemark::lab
