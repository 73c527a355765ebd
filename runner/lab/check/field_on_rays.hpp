// The distance that a scene's march computes, at any place on its rays: in float, and in real arithmetic with
// bounds. Derived from the scene's text, so it needs no march_field.
#pragma once

#include "lab/check/probe_bench.hpp"
#include "lab/march/march_rays.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace tidemark::lab {

class FieldOnRays {
public:
    /// Prepares the rays of a grid of pixels in that state. Fails if the text cannot be followed. The bench
    /// must not draw another state while the result exists.
    static Result<FieldOnRays> create(ProbeBench& bench, const FrameState& state);

    size_t rays() const { return rays_.size(); }
    /// Returns the distance from the ray's start to the march's hit, in world units, or nothing if the march
    /// misses.
    std::optional<double> hit(size_t ray) const;
    /// Returns the largest distance that the march computed along the ray, or 0.
    double longest(size_t ray) const;

    /// Returns the distance `units` from the ray's start in float; it may be NaN or infinite. Nothing if the
    /// loop ends before it computes a distance there.
    std::optional<double> in_float(size_t ray, double units);
    /// Returns the same in real arithmetic. Nothing also if the bounds are wider than 1e-6 times the larger
    /// of 1 and the distance, or if it may be NaN or infinite.
    std::optional<double> exact(size_t ray, double units);

private:
    explicit FieldOnRays(const DrawnPass& drawn) : source_(std::make_unique<MarchRays>(drawn)) {}

    std::unique_ptr<MarchRays> source_; ///< owns the textures that the rays read
    std::vector<MarchRay> rays_;
};

} // namespace tidemark::lab
