// Lists devices that can have an OpenGL context. Runs in child processes: a driver that crashes or hangs when
// it starts is listed with that as its reason.
#pragma once

#include "base/result.hpp"
#include "platform/headless_context.hpp"

#include <vector>

namespace tidemark::cli {

/// Lists devices like platform::list_headless_devices; call it before this process has a driver. Fails
/// (ErrorCode::no_context) if the listing itself crashes or hangs.
Result<std::vector<platform::HeadlessDevice>> list_devices_apart();

} // namespace tidemark::cli
