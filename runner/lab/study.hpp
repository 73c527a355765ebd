// The definition of a study: views, series, points, and values beyond the strictest.
//
// A view of a study: a named state, independent of the picture's size.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "lab/scene_numbers.hpp"
#include "render/frame_state.hpp"
#include "shader/shader_source.hpp"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

struct View {
    std::string name;
    /// without the size, and without the mouse, which depends on it
    render::FrameState state = render::at_time(0);
    glm::dvec2 mouse{0}; ///< where it was clicked, as a share of width and height
};

/// Returns the state of the view in a picture of that size.
render::FrameState state_of(const View& view, Extent extent);

/// Parses `0;10;10@.75,.4`: times in seconds, each with an optional place of the mouse as a share of the
/// picture. The error (ErrorCode::usage) names the value that is out of range.
Result<std::vector<View>> parse_views(std::string_view text);

/// Checks time and mouse; the error names the allowed values.
Result<void> check(const View& view);

/// Returns the same view whole frames later, under a name that includes the time: a moment that the search
/// did not use.
View unseen(const View& view, double seconds_later);

/// Returns an extent of the same shape whose longer side is at most `longest`, for a search.
Extent small_of(Extent extent, int longest);
/// Returns the size of a verdict's pictures: the requested one, which takes `needed` seconds, or one of the
/// same shape that takes those that are left; at least `least` pixels on its longer side.
Extent affordable(Extent requested, double needed, double left, int least);
/// Returns the sentence for a verdict at a smaller size than the requested one.
std::string smaller_verdict(Extent judged, Extent requested);

/// Returns two moments, for scenes without views of their own.
std::vector<View> default_views();

// The definition of a study, as a value: which settings of a scene in which views, against which reference.

/// Confidence that a solver never passes the first hit.
enum class Trust { certified, bound_assumed, heuristic, unknown };
std::string_view to_string(Trust trust);

/// A solver, as one curve of a diagram: fixed settings and varied knobs.
struct Series {
    std::string name;
    Trust trust = Trust::unknown;
    std::vector<Setting> settings;
    std::vector<Axis> axes; ///< all combinations, the last axis fastest
};

/// A source of error, and the settings that remove it. Sources are removed one after another; the change at
/// each is its share.
struct ErrorSource {
    std::string name; ///< for example "budget", "epsilon", "model"
    std::vector<Setting> settings;
    bool doubles = false; ///< from here on in double precision: its share is the rounding error
};

/// Limits for a picture to be good enough in the report's sentence.
struct Promise {
    double most_wrong_percent = 0.05; ///< percent of first hits that may be wrong by more than 0.1
    double least_psnr = 50;           ///< dB
};

struct Study {
    std::string about; ///< a sentence for the report
    Extent extent{320, 180};
    glsl::Precision precision = glsl::Precision::single; ///< of the points' pictures
    std::vector<View> views;
    std::vector<Series> series;
    std::vector<Axis> axes; ///< every knob from coarse to strict; empty: taken from the series
    std::vector<Setting>
        reference; ///< empty: the strictest values of the axes, made stricter until nothing changes
    std::optional<double>
        enough{}; ///< largest error of the pictures' truth, RMSE; nullopt: chosen by the points' errors
    std::vector<ErrorSource> sources;
    std::vector<Setting> model;         ///< settings without the scene's own approximations
    std::vector<std::string> omissions; ///< parts of the scene that were left out, and why
    Promise promise;
    std::vector<std::string> even; ///< knobs whose values must be even, as Simpson's rule requires
    bool as_it_is = false;         ///< the pictures' truth is the unchanged scene
    bool promote = true;           ///< the pictures' truth is drawn in double if possible
    int first_step = 0; ///< of the ladder of ever stricter settings, if earlier ones are known to differ
    bool rays = true;   ///< also measures hits, if the scene provides them
    /// Seconds. A step of the reference pictures' ladder that takes longer is its last: the next one would
    /// take twice as long, in doubles several times.
    double longest_step = 10;
    double proof_seconds = 20; ///< seconds of each core, for proofs of the hits; 0: no proofs
};

/// One point of a diagram: a solver and its settings.
struct Point {
    size_t series = 0;
    std::string label; ///< for example "SOLVER = MARCH_AUTO, MAX_STEPS = 64"
    std::string knob;  ///< the values of the axes alone, for example "64"
    std::vector<Setting> settings;
};

/// Returns the unchanged scene, then every combination of every series, each setting once.
std::vector<Point> points_of(const Study& study);

inline constexpr std::string_view k_defaults = "defaults";

/// Converts axes of a command line: the last one is varied along a curve, each combination of the others is a
/// curve.
std::vector<Series> series_of(const std::vector<Axis>& axes);

/// Reads a study file. Errors (ErrorCode::load) name `file`, with a JSON pointer to the value. The schema is
/// in runner/cli/manual/study.md, "Study files".
Result<Study> parse_study(std::string_view text, const std::string& file);

// Continues the values of a knob beyond the strictest one, for references that are refined until nothing
// changes. Pure.

/// Returns the number if the whole text is a plain, finite number.
std::optional<double> number_of(const std::string& text);

/// Returns whether GLSL reads a number as an int: `64` is an int, `64.0` a float.
bool is_int(const std::string& number);

/// Multiplies a number, keeping its type; nullopt if a whole number would leave the range 1 to 2^30.
std::optional<std::string> scaled(const std::string& text, double factor);

/// Returns the value `steps` beyond the end of the axis: in the ratio of its last two values, at least a
/// factor of 2, and of a whole number at most of 4. Returns nullopt for texts that are not numbers, a single
/// value, and whole numbers that would fall below 1. A negative `steps` goes back.
std::optional<std::string> beyond(const Axis& axis, int steps);

/// Returns every knob that a study varies, with its values from coarse to strict: the axes of its last
/// series, and the knobs that this series fixes and others fix differently.
std::vector<Axis> axes_of(const Study& study);

/// Returns the settings at which the study is most exact, `steps` steps beyond its own: its reference
/// settings if it has some, twice as strict at each step, else the end of each axis. They equal those of
/// `steps` - 1 if no value can continue. A negative `steps` is coarser.
std::vector<Setting> strictest(const Study& study, int steps);

/// Returns settings off that ladder, which reveal values that repeat on it: each number that can continue is
/// 1.37 times as strict, and a whole number changes between odd and even. With `second`, a whole number is
/// one step further, so no cycle of any length stays hidden, and other numbers are 1.71 times as strict.
/// Numbers of `study.even` stay even.
std::vector<Setting> beside(const Study& study, int steps, bool second);

/// Returns the knobs whose given values are all even numbers.
std::vector<std::string> knobs_with_even_values(const Study& study);

} // namespace tidemark::lab
