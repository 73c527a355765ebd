// Measures the wall-clock and CPU time of a piece of work.
#pragma once

#include <chrono>

namespace tidemark::lab {

/// Milliseconds of wall-clock time, and of CPU time of all threads of this process.
struct Elapsed {
    double wall = 0;
    double cpu = 0;
};

/// A clock that starts at construction.
class Stopwatch {
public:
    Stopwatch();
    Elapsed elapsed() const;

private:
    std::chrono::steady_clock::time_point wall_;
    double cpu_;
};

} // namespace tidemark::lab
