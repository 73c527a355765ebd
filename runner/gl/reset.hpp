// Detects context resets and exhausted memory after work was given to the driver.
#pragma once

#include "base/result.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::gl {

/// Returns why the driver reset the current context, as text; nothing while the context works. After a reset
/// all its objects are lost and read-back pixels are meaningless. A context without reset notification never
/// reports one.
std::optional<std::string_view> reset_reason();

/// Returns whether the current context has reset notification.
bool tells_resets();

/// Fails with ErrorCode::timed_out when the context was reset, and with ErrorCode::no_memory when memory ran
/// out since the last call. `what` completes the phrase "while …".
Result<void> check_work(std::string_view what);

} // namespace tidemark::gl
