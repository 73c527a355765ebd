// What the driver says of the work that it was given: whether it still has the context, and had the memory.
#pragma once

#include "base/result.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::gl {

/// Why the driver has reset the current context, as words; nothing while it lives. All that was in it is gone
/// then, and what is read of it is no picture. A context that was not made to tell never does.
std::optional<std::string_view> reset_reason();

/// Whether the current context was made so that it tells.
bool tells_resets();

/// Fails with ErrorCode::timed_out where the context was reset, and with ErrorCode::no_memory where memory
/// ran out since this was last asked. `what` completes "while …".
Result<void> check_work(std::string_view what);

} // namespace tidemark::gl
