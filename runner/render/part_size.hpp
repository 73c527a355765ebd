// Chooses the size of a frame's parts so that the driver finishes each in about 25 ms, from the times of the
// last parts and of the same rows in the last frame. Pure.
#pragma once

#include "render/part_cursor.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace tidemark::render {

class PartSize {
public:
    /// Returns the pixels of the next part, which begins where `ahead` does. Without measurements the first
    /// part is small, and the next ones grow.
    size_t pixels(const Part& ahead) const;
    /// Records the time of a part, in a face of that size.
    void drew(const Part& part, Extent face, double milliseconds);

    /// Limits the next part to `pixels`; for changes after which frames may take a different time.
    void doubt(size_t pixels) { recent_ = std::min(recent_, std::max(pixels, k_first)); }

private:
    size_t known_pixels(const Part& ahead, const std::vector<double>& rows) const;

    static constexpr size_t k_first = 256;

    size_t recent_ = k_first; ///< estimate from the last parts
    /// Milliseconds per pixel in each row of a pass's face, the mean of the last drawing; 0: not drawn yet.
    std::map<std::pair<size_t, int>, std::vector<double>> rows_;
};

} // namespace tidemark::render
