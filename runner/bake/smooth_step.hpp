// One curve that heights, masks and noise are blended with. Sums and products only: the same bits everywhere.
#pragma once

#include <algorithm>

namespace tidemark::bake {

/// 0 up to `from`, 1 beyond `to`, without a corner between.
inline double rise(double from, double to, double x) {
    const double part = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part);
}

} // namespace tidemark::bake
