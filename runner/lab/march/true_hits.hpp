// Proves the place at which each ray of a picture first hits the surface, from the scene's own text: the
// first zero of the distance that its march measures, in real arithmetic, on rays set up in double. If that
// distance has no zeros, as for fractals, it is the first place at which it falls below the march's
// threshold.
#pragma once

#include "lab/hits.hpp"
#include "lab/march/march_rays.hpp"
#include "lab/watch.hpp"

#include <cstddef>
#include <optional>

namespace tidemark::lab {

struct TrueHits {
    ir::Surface surface = ir::Surface::zero;
    /// NaN: not searched, or not known; -1: no hit up to the march's limit, or no loop is entered.
    Hits hits;
    size_t looked_at = 0;
    size_t unknown = 0; ///< of the pixels searched
    double half_width = 0; ///< of the proved places, root mean square
};

/// Searches as many pixels, evenly spread, as `seconds` of each core allow. Returns nullopt if `keep_going`
/// cancels it.
std::optional<TrueHits> true_hits(const DrawnPass& drawn, double seconds, const KeepGoing& keep_going);

} // namespace tidemark::lab
