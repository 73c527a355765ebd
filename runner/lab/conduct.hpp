// Runs a study: draws every point in every view, compares it with the truths, and times it. Needs a current
// context.
#pragma once

#include "base/measurement.hpp"
#include "lab/outcome.hpp"
#include "lab/specimen.hpp"
#include "lab/work_precision.hpp"
#include "scene/scene.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

/// The pictures that the numbers come from.
struct Evidence {
    std::vector<image::Image> reference;             ///< by view
    std::vector<std::vector<image::Image>> pictures; ///< by point and view
    std::vector<std::vector<image::Image>> causes;   ///< by point and view; empty without hits
};

struct Findings {
    WorkPrecisionSet set;
    Evidence evidence;
};

/// A point that fails is part of the result. The study fails (ErrorCode::usage, ErrorCode::load) if a setting
/// does not exist or the unchanged scene does not compile, and (ErrorCode::check_failed) if it is cancelled
/// before there is a reference. A study cancelled later is marked incomplete.
Result<Findings> conduct(const scene::Scene& scene, const Study& study, const Timing& timing,
                         const Watch& watch, const Circumstances& circumstances = {});

// Compares scenes with one of them, whose pictures are the truth. Needs a current context.

/// Replaces samples that are not finite by what they show here: infinity by 1, the others by 0.
std::vector<image::Image> as_shown(std::vector<image::Image> pictures);

/// Uses pictures as the truth, as shown. Fails (ErrorCode::check_failed) if no pixel of them is finite.
Result<Truth> truth_of(std::vector<image::Image> pictures);

/// Runs a study whose points are scenes, and whose truth is the pictures of the first one: `scene`,
/// unchanged. That truth has no error of its own by definition. Scenes that are not reached before a
/// cancellation are left out.
Result<Findings> compare_scenes(const scene::Scene& scene,
                                const std::vector<std::pair<std::string, scene::Scene>>& others,
                                const Study& study, const Timing& timing, const Watch& watch,
                                const Circumstances& circumstances);

} // namespace tidemark::lab
