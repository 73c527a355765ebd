#include "cli/capture/frame_choice.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::cli {

std::vector<int> evenly(const std::vector<int>& frames, size_t count) {
    count = std::min(count, frames.size());
    std::vector<int> chosen;
    for (size_t i = 0; i < count; ++i)
        chosen.push_back(frames[count == 1 ? 0 : i * (frames.size() - 1) / (count - 1)]);
    return chosen;
}

std::vector<int> beginnings(double seconds, double fps, size_t count) {
    std::vector<int> frames;
    for (size_t i = 0; i < count; ++i)
        frames.push_back(int(std::floor(seconds * fps * double(i) / double(count))));
    return frames;
}

} // namespace tidemark::cli
