// Scenes held against one of them: what that shows is what they should show. A context must be current.
#pragma once

#include "lab/study/conduct.hpp"
#include "lab/study/outcome.hpp"
#include "lab/study/specimen.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

/// Pictures as a truth, but for the pixels that are NaN or infinite. Fails (ErrorCode::check_failed) where
/// these are too many.
Result<Truth> truth_of(std::vector<image::Image> pictures);

/// A study whose points are scenes, and whose truth is the first of them: `scene`, as it is. What it shows is
/// what it shows, so that the truth has no error of its own. Those that nobody waits for any more are left
/// out.
Result<Findings> compare_scenes(const scene::Scene& scene,
                                const std::vector<std::pair<std::string, scene::Scene>>& others,
                                const Study& study, const Timing& timing, const Watch& watch,
                                const Circumstances& circumstances);

} // namespace tidemark::lab
