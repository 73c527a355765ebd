#include "lab/tune.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/conduct.hpp"
#include "lab/pass_function.hpp"
#include "lab/specimen.hpp"
#include "lab/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

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
    return goal.measure == Measure::flip ? std::max(k_part * k_part * *goal.most_error, k_part / 255)
                                         : k_part * *goal.most_error;
}

std::string blur_of(const WorkPrecisionSet& set, Measure measure, double most) {
    if (measure == Measure::wrong) {
        if (!set.has_hits())
            return "there is no reference for its hits";
        const auto own = set.hit_standard.uncertainty;
        return own && *own <= k_part * k_wrong_distance ? ""
                                                        : "the reference for its hits is not precise enough";
    }
    if (!set.picture_standard.none.empty())
        return set.picture_standard.none;
    const auto own = set.picture_standard.uncertainty;
    if (!own)
        return "the reference's own error is unknown: " + set.picture_standard.check;
    if (!(most > 0))
        return "its error cannot be told from 0: allow one with --max-error";
    const double enough = *sharpness({measure, most, {}});
    return *own <= enough
               ? ""
               : fmt::format(
                     "the reference's own error (RMSE {}) is more than a tenth of the requested error ({})",
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

namespace {

/// Longer side of the search pictures. If the unchanged scene is the truth, which needs no extra drawing,
/// they are larger and closer to the final ones.
constexpr int k_small = 96, k_small_as_it_is = 240;
/// Seconds from the last moment of the search to the verdict's extra moment.
constexpr double k_later = 2.7;
/// Share of the time budget for proofs of the hits.
constexpr double k_proof = 0.05;

struct Stage {
    double timing; ///< share of the time budget
    double step;   ///< longest step of the truth, as a share of the budget
    double end;    ///< end of everything, as a share of the budget; includes compilation and the truth
    size_t rounds;
};
constexpr Stage k_search{0.25, 0.05, 1, 9}, k_judgement{0.3, 0.15, 1.5, 30};

class Tuner {
public:
    Tuner(const scene::Scene& scene, TuneRequest request, const Watch& watch, const Circumstances& facts)
        : scene_(scene), request_(std::move(request)), watch_(watch), facts_(facts) {}

    Result<Tuned> run() {
        const WorkPrecisionSet explored = TRY(explore());
        const auto found = candidates(explored, request_.settings, request_.goal, milliseconds(explored));
        std::vector<View> views = request_.views;
        views.push_back(unseen(views.back(), k_later));
        Tuned tuned{{TRY(measure(found, request_.extent, std::move(views), k_judgement)), {}}, {}};
        TRY(judge(tuned));
        return tuned;
    }

private:
    /// Runs one study of these settings; results are discarded if the time ran out.
    Result<Findings> measure(const std::vector<std::vector<Setting>>& points, Extent extent,
                             std::vector<View> views, const Stage& stage) {
        Study study = study_of(points, request_.settings);
        study.extent = extent;
        study.views = std::move(views);
        const bool wrong = request_.goal.measure == Measure::wrong;
        study.rays = wrong; // hits need a second program for every point
        study.longest_step = stage.step * request_.seconds;
        study.proof_seconds = wrong ? k_proof * request_.seconds : 0;
        study.enough = sharpness(request_.goal);
        bool late = false;
        Watch limited = watch_;
        limited.keep_going = [&] {
            late = late || clock_.elapsed().wall * 1e-3 > stage.end * request_.seconds;
            return !late && watch_.keep_going();
        };
        const Timing timing{2, stage.rounds, stage.timing * request_.seconds,
                            [this](const WorkPrecisionSet& set) { return blur(set).empty(); }};
        auto findings = request_.as_it_is ? compare(points, study, timing, limited)
                                          : conduct(scene_, study, timing, limited, facts_);
        if (late)
            return fail(
                ErrorCode::check_failed,
                fmt::format("no result: {:g} seconds are too few for this scene: give more with --budget",
                            request_.seconds));
        return findings;
    }

    /// Uses the unchanged scene as the truth.
    Result<Findings> compare(const std::vector<std::vector<Setting>>& points, const Study& study,
                             const Timing& timing, const Watch& watch) const {
        std::vector<std::pair<std::string, scene::Scene>> scenes;
        for (const std::vector<Setting>& settings : points) {
            scene::Scene changed = TRY(with(scene_, settings));
            scenes.emplace_back(to_string(settings), std::move(changed));
        }
        Findings findings = TRY(compare_scenes(scene_, scenes, study, timing, watch, facts_));
        for (size_t i = 1; i < findings.set.points.size(); ++i)
            findings.set.points[i].point.settings = points[i - 1];
        return findings;
    }

    /// Studies the single values. If the truth does not converge for all settings, uses only those of the
    /// march.
    Result<WorkPrecisionSet> explore() {
        for (;;) {
            WorkPrecisionSet set =
                TRY(measure(single_values(request_.settings),
                            small_of(request_.extent, request_.as_it_is ? k_small_as_it_is : k_small),
                            request_.views, k_search))
                    .set;
            const std::string why = blur(set);
            if (why.empty())
                return set;
            const size_t before = request_.settings.size();
            std::erase_if(request_.settings, [](const QualitySetting& each) { return !each.march; });
            if (request_.settings.empty() || request_.settings.size() == before || !watch_.keep_going())
                return fail(ErrorCode::check_failed, "no result: " + why + without_truth());
            sentences_.push_back(
                "only the march's own settings were varied: for the others there is no reference (" + why +
                ")");
        }
    }

    /// Returns the allowed error: that of the unchanged scene if none was given.
    double most_error(const WorkPrecisionSet& set) const {
        const Goal& goal = request_.goal;
        return goal.most_error.value_or(error_by(goal.measure, set.points.front().all));
    }

    /// Returns why the truth is not good enough for that error; empty if it is.
    std::string blur(const WorkPrecisionSet& set) const {
        return blur_of(set, request_.goal.measure, most_error(set));
    }

    std::string without_truth() const {
        return request_.goal.most_milliseconds || request_.goal.measure == Measure::wrong
                   ? ""
                   : "; --as-it-is finds faster settings that show the same picture";
    }

    /// Estimates the unchanged scene's time at full size.
    double milliseconds(const WorkPrecisionSet& explored) const {
        return explored.points.front().all.time().median * double(request_.extent.pixels()) /
               double(explored.study.extent.pixels());
    }

    Result<void> judge(Tuned& tuned) {
        const WorkPrecisionSet& set = tuned.findings.set;
        const WorkPrecision& own = set.points.front();
        Goal goal = request_.goal;
        const double most = most_error(set);
        if (const std::string why = blur(set); !why.empty())
            return fail(ErrorCode::check_failed, "no result: " + why + without_truth());
        sentences_.push_back("unchanged: " + facts_of(set, own));
        const WorkPrecision* best = best_by(set, goal);
        if (!goal.most_milliseconds)
            goal.most_error = most;
        if (!best)
            sentences_.push_back("no measured setting keeps " + to_string(goal));
        else if (best == &own || !is_better(*best, own, most))
            sentences_.push_back("no measured setting is measurably better and keeps " + to_string(goal));
        else {
            tuned.chosen = best->point.settings;
            sentences_.push_back("chosen: " + best->point.label + ": " + facts_of(set, *best));
            if (const auto gain = speedup(own, *best))
                sentences_.push_back(fmt::format("{:.2f} x [{:.2f}, {:.2f}] as fast as unchanged",
                                                 gain->ratio, gain->confidence.low, gain->confidence.high));
        }
        tuned.sentences = std::move(sentences_);
        return {};
    }

    std::string facts_of(const WorkPrecisionSet& set, const WorkPrecision& point) const {
        const Measure measure = request_.goal.measure;
        return fmt::format("{}, {} {}{}", cost_of(point), to_string(Goal{measure}),
                           figure(error_by(measure, point.all)), work_of(set.study, point.point.settings));
    }

    /// Returns the work, if the scene provides it.
    std::string work_of(const Study& study, const std::vector<Setting>& settings) const {
        auto specimen = Specimen::create(scene_, {settings}, study.extent);
        if (!specimen || !specimen->has_hits())
            return "";
        const auto views = specimen->hits(study.views);
        if (!views)
            return "";
        const Hits all = joined(*views);
        const double sum = std::accumulate(all.evaluations.begin(), all.evaluations.end(), 0.0);
        return fmt::format(", {:.1f} field evaluations a pixel", sum / double(all.size()));
    }

    /// Returns whether a point is faster, if the unchanged scene keeps the error, too; or more exact, if it
    /// keeps the time.
    bool is_better(const WorkPrecision& best, const WorkPrecision& own, double most) const {
        const Measure measure = request_.goal.measure;
        if (const auto& time = request_.goal.most_milliseconds)
            return own.all.time().median > *time || error_by(measure, best.all) < error_by(measure, own.all);
        const auto gain = speedup(own, best);
        return error_by(measure, own.all) > most || (gain && gain->confidence.low > 1);
    }

    const scene::Scene& scene_;
    TuneRequest request_;
    const Watch& watch_;
    const Circumstances& facts_;
    const Stopwatch clock_{};
    std::vector<std::string> sentences_;
};

} // namespace

Result<Tuned> tune(const scene::Scene& scene, TuneRequest request, const Watch& watch,
                   const Circumstances& circumstances) {
    return Tuner(scene, std::move(request), watch, circumstances).run();
}

std::optional<MarchPlaces> march_places(const scene::Scene& scene) {
    const auto function = PassFunction::create(scene, scene.image());
    if (!function || function->loops().empty())
        return std::nullopt;
    const ir::MarchingLoop& loop = function->loops().front();
    const auto& instructions = function->function().instructions;
    MarchPlaces places{function->locate(loop.line)};
    for (const ir::Carried& carried : loop.carried)
        if (carried.update != ir::k_no_value)
            places.steps.push_back(function->locate(instructions[carried.update].line));
    if (loop.far != ir::k_no_value && instructions[loop.far].op == ir::Op::constant &&
        instructions[loop.far].type == ir::Scalar::real)
        places.far = std::bit_cast<float>(instructions[loop.far].immediate);
    return places;
}

} // namespace tidemark::lab
