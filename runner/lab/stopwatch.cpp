#include "lab/stopwatch.hpp"

#include <sys/resource.h>

namespace tidemark::lab {
namespace {

double cpu_milliseconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto milliseconds = [](const timeval& t) {
        return double(t.tv_sec) * 1e3 + double(t.tv_usec) * 1e-3;
    };
    return milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
}

} // namespace

Stopwatch::Stopwatch() : wall_(std::chrono::steady_clock::now()), cpu_(cpu_milliseconds()) {}

Elapsed Stopwatch::elapsed() const {
    const auto wall = std::chrono::steady_clock::now() - wall_;
    return {std::chrono::duration<double, std::milli>(wall).count(), cpu_milliseconds() - cpu_};
}

} // namespace tidemark::lab
