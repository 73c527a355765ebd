// The error or the time that a setting must keep, and the check of a study's points against it. Pure.
#pragma once

#include "base/result.hpp"
#include "lab/study/work_precision.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// The measure of the error. Each one is smaller if the picture is closer to the truth.
enum class Measure {
    rmse, ///< of the picture; PSNR goals are converted to it
    flip, ///< mean FLIP of the picture
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

/// Returns the largest own error of the pictures' truth, RMSE, that allows a decision about the goal; nullopt
/// if the goal does not need one.
std::optional<double> sharpness(const Goal& goal);

/// Returns why the truth's own error is too large for comparisons with `most`; empty if it is not.
std::string blur_of(const WorkPrecisionSet& set, Measure measure, double most);

/// Returns the best point by the goal: the cheapest that certainly keeps the error, or the most exact that
/// keeps the time; nullptr if there is none. Idle points are excluded.
const WorkPrecision* best_by(const WorkPrecisionSet& set, const Goal& goal);

} // namespace tidemark::lab
