// The results of a study: solvers and their settings, each with its cost and its error. Plain values; reports
// are made from them alone.
#pragma once

#include "base/extent.hpp"
#include "base/measurement.hpp"
#include "lab/hits.hpp"
#include "lab/study.hpp"
#include "media/comparison.hpp"

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// One entry for each pixel; empty: no pixel is set.
using PixelMask = std::vector<bool>;

/// The result of one point in one view, or in all views together.
struct Outcome {
    image::PictureMetrics picture; ///< over the pixels that have a truth
    size_t no_truth = 0;           ///< number of pixels without a truth
    std::optional<HitErrors> hits; ///< set if the scene's and the true hits are known
    std::array<size_t, k_causes> causes{};
    TimeSummary wall;    ///< wall clock, milliseconds a frame
    TimeSummary cpu;     ///< CPU time of the process
    TimeSummary gpu;     ///< the driver's timer, if it is trusted; else without runs
    bool by_cpu = false; ///< the study compares CPU times

    /// Returns the time by the clock that the study uses.
    const TimeSummary& time() const { return by_cpu ? cpu : gpu.runs > 0 ? gpu : wall; }
};

/// The change from removing one source of error.
struct Share {
    std::string source;
    double rms = 0;  ///< of t, world units; 0 if hits are not known
    double rmse = 0; ///< of the picture
};

/// A solver and its settings, at one cost and one error.
struct WorkPrecision {
    Point point;
    std::string failure;        ///< why nothing else is set; empty: measured
    std::vector<Outcome> views; ///< one for each view of the study
    Outcome all;                ///< all views together: errors over all their pixels, time the mean of theirs
    std::vector<Share> shares;
    /// Milliseconds of each timed run, by view and round; NaN in rounds without this point, so rounds are
    /// comparable between points.
    std::vector<std::vector<double>> wall;
    std::vector<std::vector<double>> cpu;
    std::vector<std::vector<double>> gpu; ///< empty if the driver's timer is not trusted
    double compile_milliseconds = 0;
    double first_draw_milliseconds = 0;
    bool hollow = false;   ///< its error is under ten times the reference's uncertainty
    bool own = false;      ///< its settings are the scene's own values: the same program as the first point
    bool idle = false;     ///< shows the same as an earlier point that differs only in idle knobs
    bool on_front = false; ///< no other point is both cheaper and better

    /// Returns the rounds by the clock that the study uses.
    const std::vector<std::vector<double>>& rounds() const {
        return all.by_cpu ? cpu : gpu.empty() ? wall : gpu;
    }
    bool measured() const { return failure.empty() && !views.empty(); }
    bool timed() const { return measured() && all.time().runs > 0; }
};

/// A truth, and the estimate of its error.
struct Standard {
    std::string method;                ///< description; empty: there is no truth
    std::optional<double> uncertainty; ///< in the unit of the error; nullopt: unknown
    std::string check;                 ///< how the uncertainty was found, or why it is unknown
    std::string none{};                ///< why the truth is not usable after all; no error is reported then
    size_t blind = 0;                  ///< pixels of all views without a truth
};

/// A knob that changes nothing: all pictures of a curve, and the places where its rays end, are identical.
struct IdleKnob {
    std::string name;
    std::string series;
};

/// How the error of a curve falls, as a power of its last knob.
struct ObservedOrder {
    std::string series;
    std::string knob;
    std::vector<Setting> fixed;  ///< its other knobs
    std::optional<double> order; ///< above 0: the error falls towards the strict end
    double uncertainty = 0;      ///< standard error of the fit
    std::string how;             ///< description of the fit, or why there is none
};

/// The conditions of the measurement.
struct Circumstances {
    std::string tidemark;
    std::string scene;
    std::string scene_sha256;
    std::string renderer;
    std::string driver;
    std::string started; ///< local time, ISO 8601
    double load_before = 0;
    double load_after = 0;
    int cores = 0;
    size_t warm_up_rounds = 0;
    size_t timed_rounds = 0;
    std::string clock = "wall clock around glFinish";
    bool complete = true;
    std::vector<std::string> remarks; ///< omissions and other notes for readers
};

/// Names that a report uses for its subject.
struct Words {
    std::string distance_error = "RMS error of the hit distance"; ///< used if there are hits
    std::string work = "field evaluations a pixel";
    std::string defaults = "the scene's defaults"; ///< the first point
};

struct WorkPrecisionSet {
    Study study;
    Words words;
    Circumstances circumstances;
    Standard hit_standard;
    Standard picture_standard;
    bool hits_recorded = false; ///< recorded by Tidemark from mainImage, because the author provides none
    std::vector<WorkPrecision> points; ///< points_of(study), in that order
    std::vector<Setting> scene_values; ///< the scene's own value of every knob that a point sets
    std::vector<Setting> held;         ///< numbers of the scene that no point sets; the truth has the same
    std::vector<IdleKnob> idle;
    std::vector<ObservedOrder> orders;

    bool has_hits() const { return !hit_standard.method.empty(); }
    bool has_pictures() const { return !picture_standard.method.empty(); }
    /// Returns whether the author's mainHit ranks the points; recorded hits are only reported beside the
    /// picture's error.
    bool ranked_by_hits() const { return has_hits() && !hits_recorded; }
};

/// Returns the error that diagrams and verdicts use: RMS of t if hits rank the points, else RMSE of the
/// picture.
double error_of(const WorkPrecisionSet& set, const Outcome& outcome);
/// Returns whether `a` is at most as wrong as `b`: where rays are known, fewer wrong rays come first, and
/// shares within their intervals are equal; then error_of decides. NaN is at most as wrong as nothing.
bool no_more_wrong(const WorkPrecisionSet& set, const Outcome& a, const Outcome& b);
std::string error_name(const WorkPrecisionSet& set);
const Standard& standard_of(const WorkPrecisionSet& set);

/// Returns the mean over the views of each round, by one clock.
std::vector<double> mean_of_views(const std::vector<std::vector<double>>& clock);

/// Returns the names that points set, each once, in order of appearance.
std::vector<std::string> set_names(const WorkPrecisionSet& set);
/// Returns the value of a knob at a point: its own setting, else the scene's.
std::string value_at(const WorkPrecisionSet& set, const Point& point, const std::string& name);
/// Returns the name of the point's series; k_defaults for the unchanged scene.
std::string series_name(const WorkPrecisionSet& set, const Point& point);

/// Marks hollow points and the Pareto front of error and median time. Idle points are not on the front.
void judge(WorkPrecisionSet& set);

// Times the points of a study against each other: interleaved, in an order shuffled again for every round.
// Each point has the same share of the budget, so a slow one does not cost the others their rounds. The
// caller supplies the function that draws.

/// Rounds and budget of the timing.
struct Timing {
    size_t warm_up_rounds = 10;
    size_t rounds = 30;
    /// seconds for all rounds together; there are fewer rounds if they would take longer
    double budget = 120;
    /// Called once all errors are known; false: no times are needed, so none are taken.
    std::function<bool(const WorkPrecisionSet&)> wanted = [](const WorkPrecisionSet&) { return true; };
    /// Compare CPU times: where the CPU draws, other programs hardly disturb them.
    bool by_cpu = false;
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

// The results of a study, in sentences. Pure; conclusions that the noise does not allow are left out.

/// The time of `slow` divided by that of `fast`, from rounds that were measured together.
struct Speedup {
    double ratio = 1;
    Interval confidence{}; ///< 95 %

    bool certain() const { return !confidence.contains(1.0); }
};
std::optional<Speedup> speedup(const WorkPrecision& slow, const WorkPrecision& fast);

/// Returns the cheapest point that certainly keeps the study's promise, even if the truth's own error counts
/// against it; nullptr if there is none. Idle points are excluded.
const WorkPrecision* cheapest_good(const WorkPrecisionSet& set);

/// Returns the cheapest point that is no more wrong than the unchanged scene; nullptr if nothing was timed.
/// Hollow points cannot be compared and are excluded, as are those with the scene's own settings.
const WorkPrecision* cheapest_as_exact(const WorkPrecisionSet& set);

/// For example "cheapest setting with wrong <= 0.05 % and PSNR >= 50 dB: …" or "at equal error 2.3 x [2.1,
/// 2.5] faster than the scene's defaults: …", and what limits their validity.
std::vector<std::string> sentences(const WorkPrecisionSet& set);

/// Lists the numbers that are held fixed, which the figures therefore do not cover; empty if there are none.
std::string held_sentence(const WorkPrecisionSet& set);

/// For example `4.21 ms [4.1, 4.3]`: a frame's time, with its interval if there were enough rounds.
std::string cost_of(const WorkPrecision& point);

/// Formats with three digits, for example `0.0123`.
std::string figure(double value);

} // namespace tidemark::lab
