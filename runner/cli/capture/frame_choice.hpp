// Selects frames that represent a sequence or a duration.
#pragma once

#include <cstddef>
#include <vector>

namespace tidemark::cli {

/// Returns `count` of the frames, evenly spread, including the first and the last; at most all of them.
std::vector<int> evenly(const std::vector<int>& frames, size_t count);

/// Returns the frames at which `count` equal parts of a duration begin, from frame 0 on.
std::vector<int> beginnings(double seconds, double fps, size_t count);

} // namespace tidemark::cli
