// What a setting must keep, and how a study's point is held against it. Pure.
#pragma once

#include "base/result.hpp"
#include "lab/study/work_precision.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// The error that counts. Every one is smaller where the picture is nearer to the truth.
enum class Measure {
    rmse,  ///< of the picture; PSNR is asked for as that
    flip,  ///< mean FLIP of the picture
    wrong, ///< percent of rays whose hit is off by more than 0.1
};

struct Goal {
    Measure measure = Measure::rmse;
    std::optional<double> most_error{}; ///< none: what the scene as it is has
    std::optional<double> most_milliseconds{};
};

/// `rmse=0.01`, `psnr=40dB`, `flip=0.02`, `wrong=0.05%`.
Result<Goal> parse_goal(std::string_view text);

/// `RMSE <= 0.01`, `8 ms a frame`; without a number what is measured alone.
std::string to_string(const Goal& goal);

/// NaN where it is not known.
double error_by(Measure measure, const Outcome& outcome);

/// What the own error of the truth about pictures may be, RMSE, to tell whether the goal is kept.
std::optional<double> sharpness(const Goal& goal);

/// The truth's own error where errors are compared with `most`: why it is too large to tell; empty: it is
/// not.
std::string blur_of(const WorkPrecisionSet& set, Measure measure, double most);

/// The point that the goal wants: the cheapest that is sure to keep the error, or the most exact of those
/// that keep the time; null: none does. Idle points are in no verdict.
const WorkPrecision* best_by(const WorkPrecisionSet& set, const Goal& goal);

} // namespace tidemark::lab
