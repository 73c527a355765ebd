// How fast the field of a march falls along its rays, over all of a picture: between the rays, too.
#pragma once

#include "lab/march/march_rays.hpp"

#include <vector>

namespace tidemark::lab {

/// Of the space in front of the surface that the rays of a picture cross, in pieces of some pixels each and
/// of some length along them. Ways are as long as the picture's rays go through them.
struct AreaSlopes {
    struct Bound {
        double falls; ///< by so much at most where the way is 1, beside jumps
        double way;
    };
    std::vector<Bound> bounded{};
    double may_jump = 0;   ///< of those ways
    double unbounded = 0;  ///< ways where the field may be as steep as anything, as far as is known
    double not_finite = 0; ///< or NaN, or infinite

    double bounded_way() const;
    double way() const { return bounded_way() + unbounded + not_finite; }
    /// The least number that bounds the slope on such a part of the ways that are bounded.
    double falls_on(double part) const;

    void add(const AreaSlopes& more);
};

/// In the moment of the frame; nothing where no ray enters a march.
AreaSlopes area_slopes(const MarchRays& rays, uint64_t most_evaluations);

} // namespace tidemark::lab
