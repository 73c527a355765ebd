// Seconds of a clock that never goes back, from an origin of its own.
#pragma once

#include <chrono>

namespace tidemark::cli {

inline double now_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace tidemark::cli
