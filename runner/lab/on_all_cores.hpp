// Runs independent pieces of work on all cores.
#pragma once

#include "lab/watch.hpp"

#include <cstddef>
#include <functional>

namespace tidemark::lab {

/// Calls `work` with 0 to count - 1, in any order and concurrently. Calls `keep_going` on the calling thread
/// only, before each piece that this thread takes. Once it returns false, no more pieces start and the result
/// is false.
bool on_all_cores(size_t count, const KeepGoing& keep_going, const std::function<void(size_t)>& work);

} // namespace tidemark::lab
