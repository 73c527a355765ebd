// Measures that probes of rays share: hits in percent, proofs on sampled rays, the march's own distance.
//
// Statistics of a scene's hits in a situation, as percentages of all rays, and the effect of floats on them.
// Shared by the probes of hits.
#pragma once

#include "lab/march_hits.hpp"
#include "lab/march_rays.hpp"
#include "lab/probe_bench.hpp"
#include "lab/probes.hpp"
#include "shader/survey.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
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

/// The rays of a view that run out of steps before a hit: with four times as many the recorded march hits,
/// and the pixel changes by more than 1/255, or the march was past the surface.
struct RunningOut {
    double percent = 0;
    double of_none = 0; ///< percent that run out where more steps change nothing
    double evaluations = 0;
    FrameState where{};
    image::Image map{}; ///< of those before a hit
};
/// Returns the view with the most such rays. If the march is not recorded, all rays that run out count.
/// Requires known hits.
Result<RunningOut> most_running_out(ProbeBench& bench, const std::vector<FrameState>& views);
/// Returns the answer of `probe`; `views` describes them. If another probe has reported such rays, the answer
/// refers to it.
Answer running_out_answer(ProbeBench& bench, RunningOut most, std::string_view views, std::string_view probe);
/// Returns the percentage of the rays that may be faulty: the promised one, but of a march whose author has
/// stated none under that name at least k_most_wrong_percent.
double most_allowed(const ProbeBench& bench, double promised, const std::string& name);
/// Returns the end of a sentence about a limit, in percent.
std::string allowed(double promised);

/// Returns the answer for a scene without known hits. `warns`: a mainHit that does not compile is a warning,
/// not a reference to the probe that reports it.
Answer without_hits(const ProbeBench& bench, bool warns = false);

/// Returns the answer for a recorded march for which ProbeBench::sees_below is false.
Answer without_sign();

/// Returns the verdict for faulty hits: `fail` for a mainHit, `note` for a recorded march, whose picture may
/// be right all the same.
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

// Finds the pass of a scene that marches along rays, and counts the verdicts of proofs on a sample of its
// rays.

/// Moments, in seconds, at which rays are sampled.
inline constexpr double k_ray_moments[] = {1.0 / 3, 10};
/// Most field evaluations for the proof of one ray.
inline constexpr uint64_t k_most_of_a_ray = 20'000;
/// Percent of the decided rays that may be wrong: the last ones are a matter of silhouettes.
inline constexpr double k_most_wrong_percent = 0.5;
/// Percent of the decided rays from which wrong ones are a failure; fewer are a note.
inline constexpr double k_wrong_percent_of_failure = 5;

struct MarchingPass {
    size_t index;
    const PassFunction* function;
};

/// Returns Image if it marches, else the first pass in the plan that does, else nothing.
Result<std::optional<MarchingPass>> marching_pass(ProbeBench& bench);

/// Returns the answer for a scene without such a pass, with the reason.
Answer without_march(ProbeBench& bench);

/// Calls `look` with pixels evenly spread over the picture; `look` returns the field evaluations it used.
/// Stops after 144 pixels or when 50,000 evaluations are spent.
void look_at_rays(Extent whole, const std::function<uint64_t(glm::ivec2 pixel)>& look);

/// Proves the first hits of the sampled rays of `pass` at both moments, and counts the outcomes.
Result<RayCounts> count_proved(ProbeBench& bench, const MarchingPass& pass);

/// Returns the longest step, as a multiple of the distance, that passes no first hit of the sampled rays;
/// nothing if that is not proved for most of those that hit.
Result<std::optional<double>> safe_step(ProbeBench& bench, const MarchingPass& pass);

/// Returns the percentage of the decided rays that step over their first hit or miss it.
double wrong_percent(const RayCounts& counts);

// The distance that a scene's march computes, at any place on its rays: in float, and in real arithmetic with
// bounds. Derived from the scene's text, so it needs no march_field.

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
