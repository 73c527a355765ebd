// Where the rays of a picture first meet the surface, proved from the scene's own text: the first zero of the
// distance that its march measures, in real arithmetic, on rays set up in double. Where that has no zeros, as
// with fractals: the first place where it falls below the march's threshold.
#pragma once

#include "lab/hits.hpp"
#include "lab/march/march_rays.hpp"
#include "lab/watch.hpp"

#include <cstddef>
#include <optional>

namespace tidemark::lab {

struct TrueHits {
    ir::Surface surface = ir::Surface::zero;
    /// NaN: not looked at, or not known; -1: nothing up to the march's limit, or no loop is entered.
    Hits hits;
    size_t looked_at = 0;
    size_t unknown = 0;    ///< of those
    double half_width = 0; ///< of the proved places, root of the mean square
};

/// Of as many pixels, evenly spread, as `seconds` of each core allow. Nothing where `keep_going` ends it.
std::optional<TrueHits> true_hits(const DrawnPass& drawn, double seconds, const KeepGoing& keep_going);

} // namespace tidemark::lab
