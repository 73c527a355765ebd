// Times the points of a study against each other: interleaved, in an order shuffled again for every round.
// Each point has the same share of the budget, so a slow one does not cost the others their rounds. The
// caller supplies the function that draws.
#pragma once

#include "lab/stopwatch.hpp"
#include "lab/study/work_precision.hpp"
#include "lab/watch.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace tidemark::lab {

/// Rounds and budget of the timing.
struct Timing {
    size_t warm_up_rounds = 10;
    size_t rounds = 30;
    /// seconds for all rounds together; there are fewer rounds if they would take longer
    double budget = 120;
    /// Called once all errors are known; false: no times are needed, so none are taken.
    std::function<bool(const WorkPrecisionSet&)> wanted = [](const WorkPrecisionSet&) { return true; };
};

/// The cost of one run.
struct Cost {
    Elapsed elapsed;
    std::optional<double> gpu; ///< milliseconds by the driver's timer, if it was requested and exists
};

/// Draws a point in a view once, from idle to idle. The driver's timer is used only with `ask_gpu`, because
/// it slows some drivers down.
using Run = std::function<Cost(size_t point, size_t view, bool ask_gpu)>;

/// Returns whether a point takes part in a round if it can afford `affordable` of `total` rounds: evenly
/// spread, and always in the last round, so that all points meet there.
bool takes_part(size_t round, size_t affordable, size_t total);

/// Compares the driver's timer with the wall clock around glFinish, which is reliable but has its own cost.
struct ClockComparison {
    double least = std::numeric_limits<double>::infinity(); ///< least ratio of the two
    double most = 0;
    size_t compared = 0;

    void add(double gpu, double wall);
    /// Returns whether all ratios are within a tenth of 1.
    bool agree() const;
    /// Returns which clock a study with this comparison uses, and why.
    std::string clock() const;
};

/// Fills the times of every measured point of `set`; returns false if it was cancelled before all rounds were
/// done. Verdicts use the driver's timer if it agrees with the wall clock in the warm-up rounds (medians of
/// every point and view), else the wall clock.
bool time_points(const Timing& timing, const Watch& watch, const Run& run, WorkPrecisionSet& set);

} // namespace tidemark::lab
