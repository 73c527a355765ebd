// Finds the pass of a scene that marches along rays, and counts the verdicts of proofs on a sample of its
// rays.
#pragma once

#include "lab/check/probe.hpp"
#include "lab/check/probe_bench.hpp"
#include "lab/march/proved_hits.hpp"

#include <functional>
#include <optional>

namespace tidemark::lab {

/// Moments, in seconds, at which rays are sampled.
inline constexpr double k_ray_moments[] = {1.0 / 3, 10};
/// Most field evaluations for the proof of one ray.
inline constexpr uint64_t k_most_of_a_ray = 20'000;
/// Percent of the decided rays that may be wrong: the last ones are a matter of silhouettes.
inline constexpr double k_most_wrong_percent = 0.5;

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

/// Returns the percentage of the decided rays that step over their first hit or miss it.
double wrong_percent(const RayCounts& counts);

} // namespace tidemark::lab
