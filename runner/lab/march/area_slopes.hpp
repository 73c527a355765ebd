// Bounds how fast the field of a march falls along its rays, over the whole picture, including between the
// rays.
#pragma once

#include "lab/march/march_rays.hpp"

#include <vector>

namespace tidemark::lab {

/// Bounds for the space before the surface that a picture's rays cross, divided into pieces of some pixels
/// each and some length along them. Lengths are those of the picture's rays through the pieces.
struct AreaSlopes {
    struct Bound {
        double falls; ///< most the field falls per unit of length, outside of jumps
        double way;
    };
    std::vector<Bound> bounded{};
    double may_jump = 0; ///< the part of the bounded length in which it may jump
    double unbounded = 0; ///< length in which no bound of the slope is known
    double not_finite = 0; ///< length in which it may be NaN or infinite

    double bounded_way() const;
    double way() const { return bounded_way() + unbounded + not_finite; }
    /// Returns the least bound of the slope that holds for the share `part` of the bounded length.
    double falls_on(double part) const;

    void add(const AreaSlopes& more);
};

/// Computes the bounds for the frame's time. They are empty if no ray enters a march.
AreaSlopes area_slopes(const MarchRays& rays, uint64_t most_evaluations);

} // namespace tidemark::lab
