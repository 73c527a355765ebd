// Clocks for a piece of work.
#pragma once

#include <chrono>

namespace tidemark::lab {

/// Milliseconds on the wall, and of CPU in all threads of this process.
struct Elapsed {
    double wall = 0;
    double cpu = 0;
};

/// Runs from its making.
class Stopwatch {
public:
    Stopwatch();
    Elapsed elapsed() const;

private:
    std::chrono::steady_clock::time_point wall_;
    double cpu_;
};

} // namespace tidemark::lab
