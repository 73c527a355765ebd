#include "lab/tune/goal.hpp"

#include "lab/study/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace tidemark::lab {
namespace {

/// A truth is good enough if its own error is at most this share of the error in question.
constexpr double k_part = 0.1;

struct Unit {
    std::string_view name, unit;
    Measure measure;
};
constexpr std::array k_units{Unit{"rmse", "", Measure::rmse}, Unit{"psnr", "dB", Measure::rmse},
                             Unit{"flip", "", Measure::flip}, Unit{"wrong", "%", Measure::wrong}};

Error not_a_goal(std::string_view text) {
    return {ErrorCode::usage,
            fmt::format("--max-error {}: give rmse=0.01, psnr=40dB, flip=0.02 or wrong=0.05%", text),
            {}};
}

/// A point that looks the same as the scene is not a better choice, whatever its times are.
bool may_be_chosen(const WorkPrecision& point) {
    return point.measured() && !point.idle && point.all.time().runs > 0;
}

/// Returns the largest error that the point may have, including the truth's own error.
double largest_error(const WorkPrecisionSet& set, const WorkPrecision& point, Measure measure) {
    if (measure == Measure::wrong)
        return point.all.hits ? point.all.hits->most_wrong_tenth : std::nan("");
    const double own = measure == Measure::rmse ? set.picture_standard.uncertainty.value_or(std::nan("")) : 0;
    return error_by(measure, point.all) + own;
}

} // namespace

Result<Goal> parse_goal(std::string_view text) {
    const size_t equals = text.find('=');
    const auto name = text.substr(0, equals);
    const auto unit = std::ranges::find(k_units, name, &Unit::name);
    if (equals == std::string_view::npos || unit == k_units.end())
        return fail(not_a_goal(text));
    std::string_view number = text.substr(equals + 1);
    if (!unit->unit.empty() && number.ends_with(unit->unit))
        number.remove_suffix(unit->unit.size());
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc{} || end != number.data() + number.size() || !(value > 0) || !std::isfinite(value))
        return fail(not_a_goal(text));
    return Goal{unit->measure, name == "psnr" ? std::pow(10.0, -value / 20) : value, {}};
}

std::string to_string(const Goal& goal) {
    if (goal.most_milliseconds)
        return fmt::format("{} ms a frame", figure(*goal.most_milliseconds));
    static constexpr std::array k_names{"RMSE", "FLIP", "wrong rays"};
    const std::string name = k_names[size_t(goal.measure)];
    const char* const unit = goal.measure == Measure::wrong ? " %" : "";
    return goal.most_error ? fmt::format("{} <= {}{}", name, figure(*goal.most_error), unit) : name;
}

double error_by(Measure measure, const Outcome& outcome) {
    switch (measure) {
    case Measure::rmse: return outcome.picture.samples.rmse;
    case Measure::flip: return outcome.picture.flip;
    case Measure::wrong: return outcome.hits ? outcome.hits->wrong_tenth : std::nan("");
    }
    return std::nan("");
}

std::optional<double> sharpness(const Goal& goal) {
    if (!goal.most_error || goal.measure == Measure::wrong)
        return std::nullopt;
    // FLIP has no error of its own: use a tenth of an 8-bit step, or a hundredth of the allowed error.
    return goal.measure == Measure::flip ? std::max(k_part * k_part * *goal.most_error, k_part / 255)
                                         : k_part * *goal.most_error;
}

std::string blur_of(const WorkPrecisionSet& set, Measure measure, double most) {
    if (measure == Measure::wrong) {
        if (!set.has_hits())
            return "there is no truth about where its rays end";
        const auto own = set.hit_standard.uncertainty;
        return own && *own <= k_part * k_wrong_distance
                   ? ""
                   : "where its rays really end is not known well enough";
    }
    if (!set.picture_standard.none.empty())
        return set.picture_standard.none;
    const auto own = set.picture_standard.uncertainty;
    if (!own)
        return "the truth's own error is unknown: " + set.picture_standard.check;
    if (!(most > 0))
        return "it has no error that could be told from none: allow one with --max-error";
    const double enough = *sharpness({measure, most, {}});
    return *own <= enough
               ? ""
               : fmt::format("the truth's own error (RMSE {}) is more than a tenth of what is asked ({})",
                             figure(*own), figure(most));
}

const WorkPrecision* best_by(const WorkPrecisionSet& set, const Goal& goal) {
    const WorkPrecision& own = set.points.front();
    const double most = goal.most_error.value_or(error_by(goal.measure, own.all));
    const WorkPrecision* best = nullptr;
    for (const WorkPrecision& point : set.points) {
        if (!may_be_chosen(point))
            continue;
        const double time = point.all.time().median, error = error_by(goal.measure, point.all);
        if (goal.most_milliseconds) {
            if (point.all.time().confidence.high <= *goal.most_milliseconds &&
                (!best || error < error_by(goal.measure, best->all)))
                best = &point;
            continue;
        }
        const bool keeps = goal.most_error ? largest_error(set, point, goal.measure) <= most : error <= most;
        if (keeps && (!best || time < best->all.time().median))
            best = &point;
    }
    return best;
}

} // namespace tidemark::lab
