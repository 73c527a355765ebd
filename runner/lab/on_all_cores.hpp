// Work that falls into pieces, on all cores.
#pragma once

#include "lab/watch.hpp"

#include <cstddef>
#include <functional>

namespace tidemark::lab {

/// `work` on 0 to count - 1, in any order, several at once. `keep_going` is asked on the calling thread;
/// false: it ended the work before all was done.
bool on_all_cores(size_t count, const KeepGoing& keep_going, const std::function<void(size_t)>& work);

} // namespace tidemark::lab
