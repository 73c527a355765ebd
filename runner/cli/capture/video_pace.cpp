#include "cli/capture/video_pace.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>

namespace tidemark::cli {

VideoPace pace_of(const std::vector<int>& frames, double fps) {
    if (frames.size() < 2)
        return {fps};
    const int stride = frames[1] - frames[0];
    const bool even = std::adjacent_find(frames.begin(), frames.end(),
                                         [&](int a, int b) { return b - a != stride; }) == frames.end();
    if (!even || stride == 0)
        return {fps, "its frames are not evenly apart and come one after another"};
    if (stride < 0)
        return {fps / -stride, "its frames go backwards"};
    return {fps / stride};
}

} // namespace tidemark::cli
