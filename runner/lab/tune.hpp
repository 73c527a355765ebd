// `tidemark tune`: the goal, the settings that can be varied, predictions, and the search.
//
// The error or the time that a setting must keep, and the check of a study's points against it. Pure.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "lab/conduct.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/work_precision.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// The measure of the error. Each one is smaller if the picture is closer to the truth.
enum class Measure {
    rmse,  ///< of the picture; PSNR goals are converted to it
    flip,  ///< mean FLIP of the picture
    wrong, ///< percent of rays whose hit is wrong by more than 0.1
};

struct Goal {
    Measure measure = Measure::rmse;
    std::optional<double> most_error{}; ///< nullopt: the error of the unchanged scene
    std::optional<double> most_milliseconds{};
};

/// Parses `rmse=0.01`, `psnr=40dB`, `flip=0.02` or `wrong=0.05%`.
Result<Goal> parse_goal(std::string_view text);

/// For example `RMSE <= 0.01` or `8 ms a frame`; without a number only the measure.
std::string to_string(const Goal& goal);

/// Returns NaN if the error is not known.
double error_by(Measure measure, const Outcome& outcome);

/// Returns the truth's own error in that measure; 0 if none is known for it, NaN if it is unknown.
double own_error(const WorkPrecisionSet& set, Measure measure);
/// Returns the largest error that the point may have: in its worst view, with the truth's own error, and with
/// room for moments that were not drawn.
double largest_error(const WorkPrecisionSet& set, const WorkPrecision& point, Measure measure);
/// Returns the least error that the point may have.
double least_error(const WorkPrecisionSet& set, const WorkPrecision& point, Measure measure);
/// Returns false for points that look the same as the scene or are it: whatever their times, they are not a
/// better choice.
bool may_be_chosen(const WorkPrecision& point);

/// Returns the largest own error of the pictures' truth, RMSE, that allows a decision about the goal; nullopt
/// if the goal does not need one.
std::optional<double> sharpness(const Goal& goal);

/// Returns why the truth's own error is too large for comparisons with `most`; empty if it is not.
std::string blur_of(const WorkPrecisionSet& set, Measure measure, double most);

/// Returns the best point by the goal: the cheapest that certainly keeps the error, or the most exact that
/// keeps the time; nullptr if there is none. Idle points are excluded.
const WorkPrecision* best_by(const WorkPrecisionSet& set, const Goal& goal);

// The common part of requests to, and results of, searches for a better scene.

struct SearchRequest {
    Goal goal{};
    Extent extent{320, 180};   ///< of the verdict's pictures
    std::vector<View> views{}; ///< used by the search; the verdict has more
    double seconds = 60;       ///< for everything
};

struct SearchOutcome {
    Findings findings; ///< of the last study: the unchanged scene, and the results of the search
    std::vector<std::string> sentences{}; ///< for the user, in this order
};

// Finds the numbers of a scene that trade exactness for time: iteration limits, thresholds of marches, step
// lengths. All other numbers belong to the picture and are left alone.

struct QualitySetting {
    enum class Role { bound, threshold, step };
    Axis axis;         ///< from the coarsest value to the strictest
    size_t own = 0;    ///< index of the scene's own value; the number of values if it is not among them
    std::string why{}; ///< for example "bounds the march at a.glsl:12"
    Role role = Role::bound;
    bool march = false; ///< it belongs to the marching loop, whatever its name is
};

struct QualitySettings {
    std::vector<QualitySetting> found{};
    std::vector<std::string> left{}; ///< numbers at such a place whose names do not confirm it
};

/// The places of Image's marching loop.
struct MarchPlaces {
    SourceLocation test;                 ///< comparison of the distance
    std::vector<SourceLocation> steps{}; ///< updates of the ray's place
    std::optional<double> far{};         ///< limit of the ray, if it is a constant of the text
};

/// Recognises numbers by the place of their names in the text, and by the names themselves if the place is
/// ambiguous. Numbers without a name count only in the marching loop, each by its place.
QualitySettings quality_settings(const scene::Scene& scene, const std::optional<MarchPlaces>& march);

/// Removes the stricter values, for a search in which the unchanged scene is the truth: they cost more and
/// look different.
void leave_out_stricter(QualitySetting& setting);

/// Converts an axis from the command line.
QualitySetting quality_setting(const scene::Scene& scene, Axis axis);

// Predicts from a study of single settings which combinations are worth measuring: a model, not a
// measurement. Pure.

/// Returns a study of the unchanged scene and of the scene with each of these lists of settings. The
/// settings' own axes define the order from coarse to strict.
Study study_of(const std::vector<std::vector<Setting>>& points, const std::vector<QualitySetting>& settings);

/// Returns every value of every setting, with the other settings as in the scene.
std::vector<std::vector<Setting>> single_values(const std::vector<QualitySetting>& settings);

/// Returns combinations that may be best by the goal, along the front of error and time around the target.
/// `explored` is a study of single_values(); `milliseconds` is the unchanged scene's time at the size that
/// the goal's time refers to. The model multiplies time factors, and adds squared errors, or shares of wrong
/// rays.
std::vector<std::vector<Setting>> candidates(const WorkPrecisionSet& explored,
                                             const std::vector<QualitySetting>& settings, const Goal& goal,
                                             double milliseconds);

// Finds the settings of a scene that keep an error in the least time, or a time with the least error:
// explored one by one on small pictures, combined by a model, then measured against the unchanged scene.
// Needs a current context.

struct TuneRequest : SearchRequest {
    std::vector<QualitySetting> settings{};
    bool as_it_is = false; ///< errors are measured against the unchanged scene, not against a truth
};

struct Tuned : SearchOutcome {
    std::vector<Setting> chosen{}; ///< empty: no better settings were found, or none can be established
};

/// The error (ErrorCode::check_failed) gives the reason why a result is not possible.
Result<Tuned> tune(const scene::Scene& scene, TuneRequest request, const Watch& watch,
                   const Circumstances& circumstances);

/// A study of the scene's own quality settings, one curve each.
struct ChosenKnobs {
    std::vector<QualitySetting> settings{};
    std::vector<Axis> axes{}; ///< of the truth
    bool as_it_is = false;    ///< no truth converges: the scene as it is takes its place
    std::string why{};        ///< why settings were left out, or why there is no truth; empty: all have one
};

/// Chooses the knobs of a study without any: those whose small pictures converge together; else those of the
/// march. Needs a current context.
Result<ChosenKnobs> choose_knobs(const scene::Scene& scene, std::vector<QualitySetting> settings,
                                 const Study& study, const KeepGoing& keep_going);

/// Returns nullopt if no marching loop is found in Image.
std::optional<MarchPlaces> march_places(const scene::Scene& scene);

} // namespace tidemark::lab
