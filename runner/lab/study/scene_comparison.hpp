// Compares scenes with one of them, whose pictures are the truth. Needs a current context.
#pragma once

#include "lab/study/conduct.hpp"
#include "lab/study/outcome.hpp"
#include "lab/study/specimen.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

/// Uses pictures as the truth, except for pixels that are NaN or infinite. Fails (ErrorCode::check_failed) if
/// there are too many of those.
Result<Truth> truth_of(std::vector<image::Image> pictures);

/// Runs a study whose points are scenes, and whose truth is the pictures of the first one: `scene`,
/// unchanged. That truth has no error of its own by definition. Scenes that are not reached before a
/// cancellation are left out.
Result<Findings> compare_scenes(const scene::Scene& scene,
                                const std::vector<std::pair<std::string, scene::Scene>>& others,
                                const Study& study, const Timing& timing, const Watch& watch,
                                const Circumstances& circumstances);

} // namespace tidemark::lab
