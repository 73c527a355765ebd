#include "lab/spread.hpp"

#include <numeric>

namespace tidemark::lab {

size_t spread(size_t i, size_t count) {
    constexpr double k_golden_section = 0.6180339887498949;
    auto step = size_t(double(count) * k_golden_section) + 1;
    while (std::gcd(step, count) != 1)
        ++step;
    return i * step % count;
}

} // namespace tidemark::lab
