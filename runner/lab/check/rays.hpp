// What the rays of a scene meet in a situation, in parts of all rays, and how much of that
// floats lose: what probes of hits have in common.
#pragma once

#include "glsl/hit.hpp"
#include "lab/check/probe.hpp"
#include "lab/check/probe_bench.hpp"

#include <functional>
#include <vector>

namespace tidemark::lab {

inline constexpr Extent k_ray_extent{96, 54};

/// Straight, to the horizon, down and grazing, for scenes that turn with the mouse.
std::vector<FrameState> usual_views();
/// The one of them that sees most of the surface.
FrameState typical_view();

double percent(const Hits& hits, const std::function<bool(size_t)>& counts);
double flagged(const Hits& hits, glsl::HitFlag flag);
/// In percent: rays whose distance is NaN, infinite, or negative without being a miss.
double unanswered(const Hits& hits);
double mean_evaluations(const Hits& hits);

/// The distances in grey, the nearest white; the rays that `marks` names, and those without an answer,
/// magenta.
image::Image ray_map(const Hits& hits, Extent extent, const std::function<bool(size_t)>& marks);

/// Of the usual views that with the most rays of that flag.
struct FlaggedRays {
    double percent = 0;
    FrameState where{};
    image::Image map{}; ///< of them
};
/// Of a scene whose hits are known.
Result<FlaggedRays> most_flagged(ProbeBench& bench, glsl::HitFlag flag);

/// `warns`: of a mainHit that does not compile, too.
Answer without_hits(const ProbeBench& bench, bool warns = false);

/// Of a march that is recorded and does not see_below.
Answer without_sign();

/// `fail` of a scene that says what its rays meet; of a march that is recorded its author promised nothing.
Verdict fault(const ProbeBench& bench);

/// A view in floats and in doubles; parts of all rays, percent.
struct FloatMismatch {
    Hits in_float;
    Hits in_double;
    /// Float hits something else: further off than a pixel is wide there.
    std::vector<bool> mismatched;
    double mismatched_percent = 0;
    image::Image map; ///< of them
};
/// The error of a scene that cannot be promoted.
Result<FloatMismatch> float_mismatch(ProbeBench& bench, const FrameState& state);

/// Of the rays, that may differ where float and double agree: silhouettes depend on the last bit.
inline constexpr double k_same = 1; // percent

} // namespace tidemark::lab
