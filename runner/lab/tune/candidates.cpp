#include "lab/tune/candidates.hpp"

#include "lab/study/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

/// Limit of combinations; beyond it, the settings that save the least keep their values.
constexpr size_t k_most_combinations = 200'000;

/// Neighbours of the target on the front that are measured, too, because the model is only a model.
constexpr size_t k_bolder = 2, k_safer = 5;

/// The effect of one value of a setting by itself: a factor of the time and a summand of the error.
struct Effect {
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
std::vector<Effect> effects_of(const WorkPrecisionSet& explored, const Axis& axis, Measure measure) {
    const WorkPrecision& own = explored.points.front();
    const double base = summand(measure, error_by(measure, own.all));
    std::vector<Effect> effects{{}};
    for (const WorkPrecision& point : explored.points) {
        const auto& settings = point.point.settings;
        if (settings.size() != 1 || settings.front().name != axis.name)
            continue;
        const auto gain = speedup(own, point);
        const double error = summand(measure, error_by(measure, point.all)) - base;
        if (gain && std::isfinite(error))
            effects.push_back({settings.front(), 1 / gain->ratio, error});
    }
    return effects;
}

std::vector<Combination> combinations(const std::vector<std::vector<Effect>>& all, double base) {
    std::vector<Combination> found{{{}, 1, base}};
    for (const std::vector<Effect>& effects : all) {
        std::vector<Combination> longer;
        for (const Combination& start : found)
            for (const Effect& effect : effects) {
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
std::vector<std::vector<Effect>> effects_of(const WorkPrecisionSet& explored,
                                            const std::vector<QualitySetting>& settings, Measure measure) {
    std::vector<std::vector<Effect>> all;
    for (const QualitySetting& setting : settings)
        all.push_back(effects_of(explored, setting.axis, measure));
    std::ranges::sort(all, {}, [](const std::vector<Effect>& effects) {
        return std::ranges::min(effects, {}, &Effect::time).time;
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
    const auto front = front_of(combinations(effects_of(explored, settings, goal.measure), base));
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
