// Times the points of a study against each other: interleaved, in an order shuffled anew for every round.
// Each point has the same share of the budget, so that a slow one does not cost the others their rounds. What
// is run is the caller's affair.
#pragma once

#include "lab/stopwatch.hpp"
#include "lab/study/work_precision.hpp"
#include "lab/watch.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace tidemark::lab {

/// How often to time.
struct Timing {
    size_t warm_up_rounds = 10;
    size_t rounds = 30;
    double budget = 120; ///< seconds for all rounds together; fewer are made when they would take longer
    /// Asked with all errors known; false: no time is of interest, and none is taken.
    std::function<bool(const WorkPrecisionSet&)> wanted = [](const WorkPrecisionSet&) { return true; };
};

/// What one run took.
struct Cost {
    Elapsed elapsed;
    std::optional<double> gpu; ///< milliseconds by the driver's timer, where it was asked and there is one
};

/// Runs a point on a view once, from idle to idle. The driver's timer is asked only with `ask_gpu`: some
/// drivers are slower for it.
using Run = std::function<Cost(size_t point, size_t view, bool ask_gpu)>;

/// Whether a point takes part in that round when it can afford `affordable` of `total`: evenly spread, and
/// the last round always, so that all points meet there.
bool takes_part(size_t round, size_t affordable, size_t total);

/// The driver's timer held against the wall clock around glFinish, which cannot lie but has its own cost.
struct ClockComparison {
    double least = std::numeric_limits<double>::infinity(); ///< of the ratios of the two
    double most = 0;
    size_t compared = 0;

    void add(double gpu, double wall);
    /// Everywhere within a tenth.
    bool agree() const;
    /// Which clock a study with this comparison goes by, and why.
    std::string clock() const;
};

/// Fills the times of every measured point of `set`; false when it was stopped before all rounds were made.
/// Verdicts are by the driver's timer where it agrees with the wall clock on the warm-up rounds (medians of
/// every point and view), else by the wall clock.
bool time_points(const Timing& timing, const Watch& watch, const Run& run, WorkPrecisionSet& set);

} // namespace tidemark::lab
