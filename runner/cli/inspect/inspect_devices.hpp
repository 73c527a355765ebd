// `inspect --devices`: where OpenGL can be had; with --self-test what each device can be trusted with.
#pragma once

#include "base/result.hpp"

namespace tidemark::cli {

/// The exit code: with `self_test` that of a failed check where a device fails one.
Result<int> inspect_devices(bool self_test, bool as_json);

} // namespace tidemark::cli
