// The pass of a scene that marches along rays, and what is proved of those that probes look at.
#pragma once

#include "lab/check/probe.hpp"
#include "lab/check/probe_bench.hpp"
#include "lab/march/proved_hits.hpp"

#include <functional>
#include <optional>

namespace tidemark::lab {

/// The moments in which rays are looked at, and what the proof of one may take.
inline constexpr double k_ray_moments[] = {1.0 / 3, 10};
inline constexpr uint64_t k_most_of_a_ray = 20'000;
/// Of the decided rays; below that is a matter of silhouettes.
inline constexpr double k_most_wrong_percent = 0.5;

struct MarchingPass {
    size_t index;
    const PassFunction* function;
};

/// Image, if it does; else the first of those that lead to it.
Result<std::optional<MarchingPass>> marching_pass(ProbeBench& bench);

/// Why nothing can be proved of the rays of a scene that has none.
Answer without_march(ProbeBench& bench);

/// Pixels evenly spread over the picture; `look` says how many evaluations the ray of a pixel took, and what
/// is left when some seconds are over is not looked at.
void look_at_rays(Extent whole, const std::function<uint64_t(glm::ivec2 pixel)>& look);

Result<RayCounts> count_proved(ProbeBench& bench, const MarchingPass& pass);

/// Of the decided rays, those that step over their first hit or miss it.
double wrong_percent(const RayCounts& counts);

} // namespace tidemark::lab
