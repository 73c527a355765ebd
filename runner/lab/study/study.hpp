// What a study is to do, as a value: which settings of a scene on which views, against which reference.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "glsl/dialect.hpp"
#include "lab/setting.hpp"
#include "lab/study/view.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// What is known of a solver's promise never to pass the first hit.
enum class Trust { certified, bound_assumed, heuristic, unknown };
std::string_view to_string(Trust trust);

/// A solver, as one curve of a diagram: settings that stay and knobs that are turned.
struct Series {
    std::string name;
    Trust trust = Trust::unknown;
    std::vector<Setting> settings;
    std::vector<Axis> axes; ///< all combinations, the last axis fastest
};

/// A source of error and the settings that take it away. Sources are taken away one after another; what each
/// changes is its share.
struct ErrorSource {
    std::string name; ///< "budget", "epsilon", "model"
    std::vector<Setting> settings;
    bool doubles = false; ///< from here on in double precision: its share is the rounding's
};

/// What a picture must be to be good enough for the report's sentence.
struct Promise {
    double most_wrong_percent = 0.05; ///< first hits wrong by more than 0.1
    double least_psnr = 50;           ///< dB
};

struct Study {
    std::string about; ///< a sentence for the report
    Extent extent{320, 180};
    glsl::Precision precision = glsl::Precision::single; ///< that the points are drawn in
    std::vector<View> views;
    std::vector<Series> series;
    std::vector<Axis> axes; ///< every knob from coarse to strict; empty: the series tell
    std::vector<Setting>
        reference; ///< empty: the strictest values of the axes, made stricter until nothing moves
    std::optional<double>
        enough{}; ///< own error of the truth about pictures, RMSE; none: by the points' errors
    std::vector<ErrorSource> sources;
    std::vector<Setting> model; ///< what the scene would be without its approximations of what it shows
    std::vector<std::string> omissions; ///< what was left out, and why
    Promise promise;
    bool rays = true; ///< where they end is a question, too, as far as the scene tells it
    /// A step of the reference pictures' ladder that takes more seconds is its last: the next one would take
    /// twice as long, in doubles several times.
    double longest_step = 10;
    double proof_seconds = 20; ///< of each core, for where they really end; 0: nothing is proved
};

/// One point of a diagram: a solver and its settings.
struct Point {
    size_t series = 0;
    std::string label; ///< "SOLVER = MARCH_AUTO, MAX_STEPS = 64"
    std::string knob;  ///< "64": the values of the axes alone
    std::vector<Setting> settings;
};

/// The scene as it is, then every combination of every series, each setting once.
std::vector<Point> points_of(const Study& study);

inline constexpr std::string_view k_defaults = "defaults";

/// Axes from a command line: the last one is a curve's, each combination of the others is a curve.
std::vector<Series> series_of(const std::vector<Axis>& axes);

/// Reads a study file; `file` is named in the errors (ErrorCode::load), with a JSON pointer to the value.
/// runner/lab/study/README.md, "Study files", has the schema.
Result<Study> parse_study(std::string_view text, const std::string& file);

} // namespace tidemark::lab
