#include "cli/capture/video_pace.hpp"

#include <algorithm>
#include <numeric>

namespace tidemark::cli {
namespace {

/// Returns the differences of successive frames.
std::vector<int> strides_of(const std::vector<int>& frames) {
    std::vector<int> strides;
    for (size_t i = 1; i < frames.size(); ++i)
        strides.push_back(frames[i] - frames[i - 1]);
    return strides;
}

} // namespace

VideoPace pace_of(const std::vector<int>& frames, double fps) {
    const std::vector<int> strides = strides_of(frames);
    if (strides.empty())
        return {fps};
    const auto [least, most] = std::ranges::minmax(strides);
    if (least > 0) {
        const int tick = std::reduce(strides.begin(), strides.end(), 0, std::gcd<int, int>);
        return {fps / tick, tick, most > tick};
    }
    if (least == most && least < 0)
        return {fps / -least, 0, false, "its frames go backwards"};
    return {fps, 0, false,
            "some of its frames are not later than the one before, and they come one after another"};
}

std::vector<int> ticks_of(const std::vector<int>& frames, const VideoPace& pace) {
    std::vector<int> ticks(frames.size(), 1);
    const std::vector<int> strides = strides_of(frames);
    for (size_t i = 0; pace.holds && i < strides.size(); ++i)
        ticks[i] = strides[i] / pace.tick;
    return ticks;
}

} // namespace tidemark::cli
