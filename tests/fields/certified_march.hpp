// The first zero of a field along a ray, with a proof: steps are never longer than the field's own clearance,
// so no zero is jumped over. In double precision without directed rounding; what can escape is a stretch
// below zero that is shorter than `shortest_step`, where a ray all but touches the surface.
#pragma once

#include "fields/field.hpp"

namespace tidemark::fields {

struct CertifiedHit {
    double distance; ///< along the ray; -1: no zero in the range; NaN: the field was not a number on the way
    int samples;     ///< of the field, those of the final bisection included
    bool started_inside; ///< the range begins below the surface; `distance` is where it begins
};

struct CertifiedOptions {
    /// Lower bound of a step, world units: without one a ray that grazes the surface would never arrive.
    double shortest_step = 2e-5;
};

CertifiedHit certified_march(const Field& field, const Ray& ray, RayRange range,
                             const CertifiedOptions& options = {});

/// The part of `range` where a zero is possible at all: between the field's lowest and highest y. Empty
/// (near > far) when the ray misses that slab. A ray that begins below the slab keeps its beginning.
RayRange clip_to_slab(const Field& field, const Ray& ray, RayRange range);

} // namespace tidemark::fields
