// Progress and cancellation callbacks for long jobs.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace tidemark::lab {

/// Called between two pieces of work; returns false to stop.
using KeepGoing = std::function<bool()>;

struct Watch {
    std::function<void(const std::string& what, size_t total)> begin; ///< starts a part of `total` pieces
    std::function<void()> advance;                                    ///< one piece is done
    KeepGoing keep_going; ///< false: stop, and return the results so far
};

} // namespace tidemark::lab
