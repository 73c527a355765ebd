// Statistics of a scene's hits in a situation, as percentages of all rays, and the effect of floats on them.
// Shared by the probes of hits.
#pragma once

#include "glsl/hit.hpp"
#include "lab/check/probe.hpp"
#include "lab/check/probe_bench.hpp"

#include <functional>
#include <vector>

namespace tidemark::lab {

inline constexpr Extent k_ray_extent{96, 54};

/// Returns four views at 10 s: straight ahead with the mouse untouched and, in scenes that turn with the
/// mouse, to the horizon, down, and along the surface.
std::vector<FrameState> usual_views();
/// Returns the one that shows most of the surface.
FrameState typical_view();

/// Returns the percentage of the rays that `counts` accepts by index.
double percent(const Hits& hits, const std::function<bool(size_t)>& counts);
/// Returns the percentage of the rays with that flag.
double flagged(const Hits& hits, glsl::HitFlag flag);
/// Returns the percentage of the rays without a valid distance: NaN, infinite, or negative without being a
/// miss.
double unanswered(const Hits& hits);
double mean_evaluations(const Hits& hits);

/// Draws the distances in grey, the nearest white. Rays for which `marks` is true, and those without a valid
/// distance, are magenta.
image::Image ray_map(const Hits& hits, Extent extent, const std::function<bool(size_t)>& marks);

/// The usual view with the most rays of a flag.
struct FlaggedRays {
    double percent = 0;
    FrameState where{};
    image::Image map{}; ///< of those rays
};
/// Requires known hits (ProbeBench::has_hits).
Result<FlaggedRays> most_flagged(ProbeBench& bench, glsl::HitFlag flag);

/// Returns the answer for a scene without known hits. `warns`: a mainHit that does not compile is a warning,
/// not a reference to the probe that reports it.
Answer without_hits(const ProbeBench& bench, bool warns = false);

/// Returns the answer for a recorded march for which ProbeBench::sees_below is false.
Answer without_sign();

/// Returns the verdict for faulty hits: `fail` for a mainHit, `warn` for a recorded march, whose author
/// promised nothing.
Verdict fault(const ProbeBench& bench);

/// The hits of one view in float and in double.
struct FloatMismatch {
    Hits in_float;
    Hits in_double;
    /// Per ray: float hits where double misses or the reverse, or their distances differ by more than a
    /// pixel's width there.
    std::vector<bool> mismatched;
    double mismatched_percent = 0;
    image::Image map; ///< with the mismatched rays marked
};
/// Fails if the scene cannot be promoted to double.
Result<FloatMismatch> float_mismatch(ProbeBench& bench, const FrameState& state);

/// Percentage of the rays that may mismatch although float and double agree: silhouettes depend on the last
/// bit.
inline constexpr double k_same = 1;

} // namespace tidemark::lab
