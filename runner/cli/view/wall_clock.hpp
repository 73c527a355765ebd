// Seconds of a monotonic clock, from an arbitrary origin.
#pragma once

#include <chrono>

namespace tidemark::cli {

inline double seconds_of(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
}

inline double now_seconds() {
    return seconds_of(std::chrono::steady_clock::now());
}

} // namespace tidemark::cli
