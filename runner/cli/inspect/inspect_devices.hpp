// `inspect --devices`: lists devices that can have an OpenGL context; with --self-test checks each of them.
#pragma once

#include "base/result.hpp"

namespace tidemark::cli {

/// Returns the exit code; with `self_test`, that of a failed check if a device fails one.
Result<int> inspect_devices(bool self_test, bool as_json);

} // namespace tidemark::cli
