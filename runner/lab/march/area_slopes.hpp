// How fast the field of a march falls along its rays, over all of a picture: between the rays, too.
#pragma once

#include "lab/march/march_rays.hpp"

#include <vector>

namespace tidemark::lab {

/// Of the space in front of the surface that the rays of a picture cross, in pieces of some pixels each and
/// of some length along them. Ways are as long as the picture's rays go through them.
struct AreaSlopes {
    struct Bound {
        double falls; ///< by so much at most where the way is 1
        double way;
    };
    std::vector<Bound> bounded{};
    double jumps = 0;      ///< where the field may jump, or too much is open
    double not_finite = 0; ///< or may be NaN or infinite
    double not_entered =
        0; ///< areas, in parts of the picture, whose rays may do different things before the march

    double bounded_way() const;
    double way() const { return bounded_way() + jumps + not_finite; }
    /// The least number that bounds the slope on such a part of the ways that are bounded.
    double falls_on(double part) const;

    void add(const AreaSlopes& more);
};

/// In the moment of the frame; nothing where no ray enters a march.
AreaSlopes area_slopes(const MarchRays& rays, uint64_t most_evaluations);

} // namespace tidemark::lab
