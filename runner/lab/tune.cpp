#include "lab/tune.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tidemark::lab {
namespace {

/// Room for moments that were not drawn, as a share of the error in the worst view.
constexpr double k_spread_room = 0.25;
/// A truth is good enough if its own error is at most this share of the error in question.
constexpr double k_part_of_error = 0.1;

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

} // namespace

bool may_be_chosen(const WorkPrecision& point) {
    return point.measured() && !point.idle && !point.own && point.all.time().runs > 0;
}

double own_error(const WorkPrecisionSet& set, Measure measure) {
    return measure == Measure::rmse ? set.picture_standard.uncertainty.value_or(std::nan("")) : 0;
}

double largest_error(const WorkPrecisionSet& set, const WorkPrecision& point, Measure measure) {
    if (measure == Measure::wrong)
        return point.all.hits ? point.all.hits->most_wrong_tenth : std::nan("");
    double sum = 0, squares = 0, worst = 0;
    for (const Outcome& view : point.views) {
        const double error = error_by(measure, view);
        sum += error;
        squares += error * error;
        worst = error > worst || std::isnan(error) ? error : worst;
    }
    const auto views = double(std::max<size_t>(1, point.views.size()));
    const double spread = std::sqrt(std::max(0.0, squares / views - sum * sum / (views * views)));
    const double room = point.views.size() > 1 ? std::max(spread, k_spread_room * worst) : 0;
    return std::max(error_by(measure, point.all), worst + room) + own_error(set, measure);
}

double least_error(const WorkPrecisionSet& set, const WorkPrecision& point, Measure measure) {
    if (measure == Measure::wrong)
        return point.all.hits ? point.all.hits->least_wrong_tenth : std::nan("");
    return error_by(measure, point.all) - own_error(set, measure);
}

Result<Goal> parse_goal(std::string_view text) {
    const size_t equals = text.find('=');
    const auto name = text.substr(0, equals);
    const auto unit = std::ranges::find(k_units, name, &Unit::name);
    if (equals == std::string_view::npos || unit == k_units.end())
        return fail(not_a_goal(text));
    std::string_view number = text.substr(equals + 1);
    if (!unit->unit.empty() && number.ends_with(unit->unit))
        number.remove_suffix(unit->unit.size());
    const double value = number_from<double>(number).value_or(0);
    if (!(value > 0) || !std::isfinite(value))
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
    return goal.measure == Measure::flip
               ? std::max(k_part_of_error * k_part_of_error * *goal.most_error, k_part_of_error / 255)
               : k_part_of_error * *goal.most_error;
}

std::string blur_of(const WorkPrecisionSet& set, Measure measure, double most) {
    if (measure == Measure::wrong) {
        if (!set.has_hits())
            return "there is no reference for its hits";
        const auto own = set.hit_standard.uncertainty;
        return own && *own <= k_part_of_error * k_wrong_distance
                   ? ""
                   : "the reference for its hits is not precise enough";
    }
    if (!set.picture_standard.none.empty())
        return set.picture_standard.none;
    const auto own = set.picture_standard.uncertainty;
    if (!own)
        return "the reference's own error is unknown: " + set.picture_standard.check;
    if (!(most > 0))
        return "its error cannot be told from 0: allow one with --max-error";
    if (measure == Measure::rmse)
        return *own < most
                   ? ""
                   : fmt::format("the reference's own error (RMSE {}) is not below the requested error ({})",
                                 figure(*own), figure(most));
    const double enough = *sharpness({measure, most, {}});
    return *own <= enough
               ? ""
               : fmt::format("the reference's own error (RMSE {}) is more than {}, which FLIP {} needs",
                             figure(*own), figure(enough), figure(most));
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

namespace {

/// Limit of combinations; beyond it, the settings that save the least keep their values.
constexpr size_t k_most_combinations = 200'000;

/// Neighbours of the target on the front that are measured, too, because the model is only a model.
constexpr size_t k_bolder = 2, k_safer = 5;

/// The effect of one value of a setting by itself: a factor of the time and a summand of the error.
struct SettingEffect {
    std::optional<Setting> setting{}; ///< nullopt: the scene's own value
    double time = 1;
    double error = 0;
};

struct Combination {
    std::vector<Setting> settings{};
    double time = 1;
    double error = 0;
};

/// Converts an error to a quantity in which errors of different origin add.
double summand(Measure measure, double error) {
    return measure == Measure::wrong ? error : error * error;
}

/// Returns the effects of the values that could be measured, the scene's own first.
std::vector<SettingEffect> effects_of(const WorkPrecisionSet& explored, const QualitySetting& tuned,
                                      Measure measure, bool no_stricter) {
    const Axis& axis = tuned.axis;
    const WorkPrecision& own = explored.points.front();
    const double base = summand(measure, error_by(measure, own.all));
    std::vector<SettingEffect> effects{{}};
    for (const WorkPrecision& point : explored.points) {
        const auto& settings = point.point.settings;
        if (settings.size() != 1 || settings.front().name != axis.name)
            continue;
        const auto at = std::ranges::find(axis.values, settings.front().value) - axis.values.begin();
        if (no_stricter && size_t(at) > tuned.own)
            continue;
        const auto gain = speedup(own, point);
        const double error = summand(measure, error_by(measure, point.all)) - base;
        if (gain && std::isfinite(error))
            effects.push_back({settings.front(), 1 / gain->ratio, error});
    }
    return effects;
}

std::vector<Combination> combinations(const std::vector<std::vector<SettingEffect>>& all, double base) {
    std::vector<Combination> found{{{}, 1, base}};
    for (const std::vector<SettingEffect>& effects : all) {
        std::vector<Combination> longer;
        for (const Combination& start : found)
            for (const SettingEffect& effect : effects) {
                Combination& next = longer.emplace_back(start);
                if (effect.setting)
                    next.settings.push_back(*effect.setting);
                next.time *= effect.time;
                next.error += effect.error;
            }
        found = std::move(longer);
    }
    return found;
}

/// Returns the combinations that no other beats in both time and error, the fastest first.
std::vector<Combination> front_of(std::vector<Combination> all) {
    std::ranges::sort(all, [](const Combination& a, const Combination& b) {
        return std::pair(a.time, a.error) < std::pair(b.time, b.error);
    });
    std::vector<Combination> front;
    for (Combination& each : all)
        if (front.empty() || each.error < front.back().error)
            front.push_back(std::move(each));
    return front;
}

/// Returns the index of the fastest combination within that error; else of the most exact one.
size_t fastest(const std::vector<Combination>& front, double error) {
    const auto found =
        std::ranges::find_if(front, [&](const Combination& each) { return each.error <= error; });
    return size_t(found - front.begin()) - size_t(found == front.end());
}

/// Returns the index of the most exact combination within that time; else of the fastest one.
size_t most_exact(const std::vector<Combination>& front, double time) {
    const auto above = std::ranges::find_if(front, [&](const Combination& each) { return each.time > time; });
    return size_t(above - front.begin()) - size_t(above != front.begin());
}

/// Returns the effects of the settings that save the most, as many as can be combined.
std::vector<std::vector<SettingEffect>> effects_of(const WorkPrecisionSet& explored,
                                                   const std::vector<QualitySetting>& settings,
                                                   Measure measure, bool no_stricter) {
    std::vector<std::vector<SettingEffect>> all;
    for (const QualitySetting& setting : settings)
        all.push_back(effects_of(explored, setting, measure, no_stricter));
    std::ranges::sort(all, {}, [](const std::vector<SettingEffect>& effects) {
        return std::ranges::min(effects, {}, &SettingEffect::time).time;
    });
    size_t number = 1, kept = 0;
    while (kept < all.size() && (number *= all[kept].size()) <= k_most_combinations)
        ++kept;
    all.resize(kept);
    return all;
}

} // namespace

Study study_of(const std::vector<std::vector<Setting>>& points, const std::vector<QualitySetting>& settings) {
    Study study;
    for (const std::vector<Setting>& point : points)
        study.series.push_back({to_string(point), Trust::unknown, point, {}});
    for (const QualitySetting& setting : settings)
        study.axes.push_back(setting.axis);
    return study;
}

std::vector<std::vector<Setting>> single_values(const std::vector<QualitySetting>& settings) {
    std::vector<std::vector<Setting>> points;
    for (const QualitySetting& setting : settings)
        for (size_t i = 0; i < setting.axis.values.size(); ++i)
            if (i != setting.own)
                points.push_back({{setting.axis.name, setting.axis.values[i]}});
    return points;
}

std::vector<std::vector<Setting>> candidates(const WorkPrecisionSet& explored,
                                             const std::vector<QualitySetting>& settings, const Goal& goal,
                                             double milliseconds) {
    const double own = error_by(goal.measure, explored.points.front().all);
    const double base = summand(goal.measure, own);
    // Stricter values cost time; a scene that keeps the error has no use for them.
    const bool no_stricter = !goal.most_milliseconds && own <= goal.most_error.value_or(own);
    const auto front =
        front_of(combinations(effects_of(explored, settings, goal.measure, no_stricter), base));
    const size_t wanted = goal.most_milliseconds
                              ? most_exact(front, *goal.most_milliseconds / milliseconds)
                              : fastest(front, summand(goal.measure, goal.most_error.value_or(own)));
    std::vector<std::vector<Setting>> chosen;
    const size_t first = wanted - std::min(wanted, k_bolder);
    for (size_t i = first; i < std::min(front.size(), wanted + k_safer + 1); ++i)
        if (!front[i].settings.empty())
            chosen.push_back(front[i].settings);
    return chosen;
}

} // namespace tidemark::lab
