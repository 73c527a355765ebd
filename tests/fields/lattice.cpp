#include "fields/lattice.hpp"

#include <limits>

namespace tidemark::fields {

double IntegerLattice::operator()(int64_t x, int64_t y, int64_t z) const {
    uint32_t point = uint32_t(x) * 3518319155U + uint32_t(y) * 2882110345U + uint32_t(z) * 2360945575U;
    point = (point ^ (point >> 15)) * 0xb995450dU;
    return double(point >> 8) / 16777216.0;
}

double SineLattice::operator()(int64_t x, int64_t y, int64_t z) const {
    const int64_t index = 7 * x + 157 * y + 113 * z - first;
    if (index < 0 || index >= int64_t(values.size()))
        return std::numeric_limits<double>::quiet_NaN();
    return double(values[std::size_t(index)]);
}

} // namespace tidemark::fields
