// The size of a picture, target or window in pixels.
#pragma once

#include <cstddef>

namespace tidemark {

struct Extent {
    int width = 0;
    int height = 0;

    bool operator==(const Extent&) const = default;
    size_t pixels() const { return size_t(width) * size_t(height); }
};

} // namespace tidemark
