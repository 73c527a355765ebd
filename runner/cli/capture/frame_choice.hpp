// Some frames for many: those that stand for a sequence, or for a time.
#pragma once

#include <cstddef>
#include <vector>

namespace tidemark::cli {

/// So many of the frames, evenly spread over them, the first and the last among them; no more than there are.
std::vector<int> evenly(const std::vector<int>& frames, size_t count);

/// The frames at which so many equal parts of a time begin, from frame 0 on.
std::vector<int> beginnings(double seconds, double fps, size_t count);

} // namespace tidemark::cli
