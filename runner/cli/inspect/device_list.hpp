// Where OpenGL contexts can be had, asked in processes of their own: a driver that crashes or hangs when it
// starts is an entry like the others.
#pragma once

#include "base/result.hpp"
#include "platform/headless_context.hpp"

#include <vector>

namespace tidemark::cli {

/// As platform::list_headless_devices; before this process has a driver. Fails (ErrorCode::no_context) where
/// already to list them crashes or hangs.
Result<std::vector<platform::HeadlessDevice>> list_devices_apart();

} // namespace tidemark::cli
