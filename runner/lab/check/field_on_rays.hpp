// The distance that a scene's march measures, at any place on its rays: in float, and in real arithmetic with
// bounds. Known from the text, where no march_field says it.
#pragma once

#include "lab/check/probe_bench.hpp"
#include "lab/march/march_rays.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace tidemark::lab {

class FieldOnRays {
public:
    /// Of a grid of pixels in that state. The bench must draw no other one meanwhile.
    static Result<FieldOnRays> create(ProbeBench& bench, const FrameState& state);

    size_t rays() const { return rays_.size(); }
    /// How far it is to what the march hits, in units; none: it hits nothing.
    std::optional<double> hit(size_t ray) const;
    /// The longest distance that the march measured.
    double longest(size_t ray) const;

    /// So many units from the ray's start. Nothing where the loop is left before it measures; NaN and
    /// infinities as they come.
    std::optional<double> in_float(size_t ray, double units);
    /// Nothing where its bounds are wider than a millionth of it and of 1, too.
    std::optional<double> exact(size_t ray, double units);

private:
    explicit FieldOnRays(const DrawnPass& drawn) : source_(std::make_unique<MarchRays>(drawn)) {}

    std::unique_ptr<MarchRays> source_; ///< has the textures that the rays read
    std::vector<MarchRay> rays_;
};

} // namespace tidemark::lab
