#include "lab/check/explored.hpp"

#include <algorithm>

namespace tidemark::lab {

PixelGrid finer(const PixelGrid& grid, Extent part, uint32_t pixel, Extent whole) {
    const int x = grid.left + grid.stride * (int(pixel) % part.width);
    const int y = grid.down + grid.stride * (int(pixel) / part.width);
    const int stride = grid.stride > 4 ? 4 : 1;
    const auto first = [&](int middle, int size, int all) {
        return std::clamp(middle - stride * (size / 2), 0, all - 1 - stride * (size - 1));
    };
    return {stride, first(x, part.width, whole.width), first(y, part.height, whole.height)};
}

} // namespace tidemark::lab
