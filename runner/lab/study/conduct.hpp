// Runs a study: draws every point in every view, compares it with the truths, and times it. Needs a current
// context.
#pragma once

#include "lab/study/timing.hpp"
#include "lab/study/truth.hpp"
#include "lab/study/work_precision.hpp"
#include "lab/watch.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

/// The pictures that the numbers come from.
struct Evidence {
    std::vector<image::Image> reference; ///< by view
    std::vector<std::vector<image::Image>> pictures; ///< by point and view
    std::vector<std::vector<image::Image>> causes; ///< by point and view; empty without hits
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

} // namespace tidemark::lab
