// A study carried out: draws every point on every view, holds it against the truths, times it. A context must
// be current.
#pragma once

#include "lab/truth.hpp"
#include "lab/work_precision.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// How often to time.
struct Timing {
    size_t warm_up_rounds = 10;
    size_t rounds = 30;
    double budget = 120; ///< seconds for all rounds together; fewer are made when they would take longer
};

/// Who watches a long study.
struct Watch {
    std::function<void(const std::string& what, size_t total)> begin; ///< a part of so many pieces
    std::function<void()> advance;                                    ///< one piece is done
    KeepGoing keep_going;                                             ///< false: end with what there is
};

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
                         const Watch& watch);

} // namespace tidemark::lab
