// What a study found: solvers and their settings, each at its cost and its error. Plain values; reports are
// made of them and of nothing else.
#pragma once

#include "base/extent.hpp"
#include "image/compare/metrics.hpp"
#include "lab/hits.hpp"
#include "lab/statistics.hpp"
#include "lab/study/study.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// One for each pixel; empty: none.
using PixelMask = std::vector<bool>;

/// One point on one view, or on all views together.
struct Outcome {
    image::PictureMetrics picture; ///< over the pixels that have a truth
    size_t no_truth = 0;           ///< pixels of the picture that have none
    std::optional<HitErrors> hits; ///< where the scene's and the true ones are known
    std::array<size_t, k_causes> causes{};
    TimeSummary wall; ///< wall clock, milliseconds a frame
    TimeSummary cpu;  ///< CPU time of the process
    TimeSummary gpu;  ///< the driver's timer, where it is believed; else without runs

    /// By the clock that the study goes by.
    const TimeSummary& time() const { return gpu.runs > 0 ? gpu : wall; }
};

/// What taking one source of error away changed.
struct Share {
    std::string source;
    double rms = 0;  ///< of t, world units; 0 where hits are not known
    double rmse = 0; ///< of the picture
};

/// A solver and its settings, at one cost and one error.
struct WorkPrecision {
    Point point;
    std::string failure;        ///< why there is nothing else; empty: measured
    std::vector<Outcome> views; ///< one for each view of the study
    Outcome all;                ///< the views together: errors over all their pixels, time the mean of theirs
    std::vector<Share> shares;
    /// Milliseconds of each timed run, by view and round, NaN in rounds without this point: rounds are
    /// comparable between points.
    std::vector<std::vector<double>> wall;
    std::vector<std::vector<double>> cpu;
    std::vector<std::vector<double>> gpu; ///< empty where the driver's timer is not believed
    double compile_milliseconds = 0;
    double first_draw_milliseconds = 0;
    bool hollow = false;   ///< its error is under ten times the reference's uncertainty
    bool idle = false;     ///< shows what an earlier point shows, from which only idle knobs part it
    bool on_front = false; ///< no other point is both cheaper and better

    /// By the clock that the study goes by.
    const std::vector<std::vector<double>>& rounds() const { return gpu.empty() ? wall : gpu; }
    bool measured() const { return failure.empty() && !views.empty(); }
    bool timed() const { return measured() && all.time().runs > 0; }
};

/// A truth and what is known of it.
struct Standard {
    std::string method;                ///< in words; empty: there is none
    std::optional<double> uncertainty; ///< in the unit of the error; nothing: unknown
    std::string check;                 ///< how the uncertainty was found, or why it is unknown
    std::string none{};                ///< why there is no truth after all; no error is told then
    size_t blind = 0;                  ///< pixels of all views that have no truth
};

/// A knob that changes nothing: all pictures of a curve, and where its rays end, are the same to the bit.
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
    std::string how;             ///< the fit in words, or why there is none
};

/// How the figures came about.
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
    std::vector<std::string> remarks; ///< omissions and what else a reader should know
};

/// What a report calls its subject.
struct Words {
    std::string distance_error = "RMS error of the hit distance"; ///< where there are hits
    std::string work = "field evaluations a pixel";
    std::string defaults = "the scene's defaults"; ///< the first point
};

struct WorkPrecisionSet {
    Study study;
    Words words;
    Circumstances circumstances;
    Standard hit_standard;
    Standard picture_standard;
    bool hits_recorded = false;        ///< by us, from mainImage: no author asked for them
    std::vector<WorkPrecision> points; ///< points_of(study), in that order
    std::vector<Setting> scene_values; ///< of every knob that a point sets: what the scene itself has
    std::vector<Setting> held;         ///< numbers of the scene that no point sets: the truth has them, too
    std::vector<IdleKnob> idle;
    std::vector<ObservedOrder> orders;

    bool has_hits() const { return !hit_standard.method.empty(); }
    bool has_pictures() const { return !picture_standard.method.empty(); }
    /// Where an author says what rays meet; else hits are told beside the picture.
    bool ranked_by_hits() const { return has_hits() && !hits_recorded; }
};

/// The error that diagrams and verdicts are about: RMS of t where hits rank, else RMSE of the picture.
double error_of(const WorkPrecisionSet& set, const Outcome& outcome);
std::string error_name(const WorkPrecisionSet& set);
const Standard& standard_of(const WorkPrecisionSet& set);

/// The mean over the views of each round, of one clock.
std::vector<double> mean_of_views(const std::vector<std::vector<double>>& clock);

/// Names that points set, each once, in the order in which they come.
std::vector<std::string> set_names(const WorkPrecisionSet& set);
/// What a point has for a knob: its own setting, else the scene's.
std::string value_at(const WorkPrecisionSet& set, const Point& point, const std::string& name);
/// Of a series' name: the scene's defaults have none of their own.
std::string series_name(const WorkPrecisionSet& set, const Point& point);

/// Marks hollow points and the Pareto front of error and median time. Idle points are on no front.
void judge(WorkPrecisionSet& set);

} // namespace tidemark::lab
