// How large the parts of a frame should be, so that the driver is done with each in about 25 ms: what the
// last parts took says it, and what the same rows took in the frame before. Pure: told what a part took.
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
    /// Pixels of the next part, where it begins as `ahead` does. Of a picture about which nothing is known
    /// the first is small, and the next ones grow.
    size_t pixels(const Part& ahead) const;
    /// That part of a face of that size took so long.
    void drew(const Part& part, Extent face, double milliseconds);

    /// The next frame may take another time than all before: it begins with a part of so many pixels at most.
    void doubt(size_t pixels) { recent_ = std::min(recent_, std::max(pixels, k_first)); }

private:
    size_t known_pixels(const Part& ahead, const std::vector<double>& rows) const;

    static constexpr size_t k_first = 256;

    size_t recent_ = k_first; ///< what the parts so far ask for
    /// Milliseconds of a pixel in each row of a pass's face, the mean when it was drawn last; 0: not yet.
    std::map<std::pair<size_t, int>, std::vector<double>> rows_;
};

} // namespace tidemark::render
