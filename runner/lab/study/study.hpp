// The definition of a study, as a value: which settings of a scene in which views, against which reference.
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
    double least_psnr = 50; ///< dB
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
    std::vector<Setting> model; ///< settings without the scene's own approximations
    std::vector<std::string> omissions; ///< parts of the scene that were left out, and why
    Promise promise;
    bool rays = true; ///< also measures hits, if the scene provides them
    /// Seconds. A step of the reference pictures' ladder that takes longer is its last: the next one would
    /// take twice as long, in doubles several times.
    double longest_step = 10;
    double proof_seconds = 20; ///< seconds of each core, for proofs of the hits; 0: no proofs
};

/// One point of a diagram: a solver and its settings.
struct Point {
    size_t series = 0;
    std::string label; ///< for example "SOLVER = MARCH_AUTO, MAX_STEPS = 64"
    std::string knob; ///< the values of the axes alone, for example "64"
    std::vector<Setting> settings;
};

/// Returns the unchanged scene, then every combination of every series, each setting once.
std::vector<Point> points_of(const Study& study);

inline constexpr std::string_view k_defaults = "defaults";

/// Converts axes of a command line: the last one is varied along a curve, each combination of the others is a
/// curve.
std::vector<Series> series_of(const std::vector<Axis>& axes);

/// Reads a study file. Errors (ErrorCode::load) name `file`, with a JSON pointer to the value. The schema is
/// in runner/lab/study/README.md, "Study files".
Result<Study> parse_study(std::string_view text, const std::string& file);

} // namespace tidemark::lab
