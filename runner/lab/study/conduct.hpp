// A study carried out: draws every point on every view, holds it against the truths, times it. A context must
// be current.
#pragma once

#include "lab/study/timing.hpp"
#include "lab/study/truth.hpp"
#include "lab/study/work_precision.hpp"
#include "lab/watch.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

/// The pictures behind the numbers.
struct Evidence {
    std::vector<image::Image> reference;             ///< by view
    std::vector<std::vector<image::Image>> pictures; ///< by point and view
    std::vector<std::vector<image::Image>> causes;   ///< by point and view; empty without hits
};

struct Findings {
    WorkPrecisionSet set;
    Evidence evidence;
};

/// A point that fails is a finding; the study fails (ErrorCode::usage, ErrorCode::load) when a setting does
/// not exist or the scene as it is does not compile. What was interrupted is marked incomplete.
Result<Findings> conduct(const scene::Scene& scene, const Study& study, const Timing& timing,
                         const Watch& watch, const Circumstances& circumstances = {});

} // namespace tidemark::lab
