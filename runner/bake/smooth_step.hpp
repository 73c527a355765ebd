// The curve that blends heights, masks and noise. Sums and products only: the same bits on every machine.
#pragma once

#include <algorithm>

namespace tidemark::bake {

/// Returns 0 up to `from` and 1 beyond `to`, with a smooth transition.
inline double rise(double from, double to, double x) {
    const double part = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part);
}

} // namespace tidemark::bake
