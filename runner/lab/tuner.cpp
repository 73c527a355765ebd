#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/conduct.hpp"
#include "lab/outcome.hpp"
#include "lab/pass_function.hpp"
#include "lab/specimen.hpp"
#include "lab/truth.hpp"
#include "lab/tune.hpp"
#include "lab/work_precision.hpp"
#include "render/frame_plan.hpp"
#include "render/gl_context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace tidemark::lab {
namespace {

/// Longer side of the search pictures. If the unchanged scene is the truth, which needs no extra drawing,
/// they are larger and closer to the final ones.
constexpr int k_small_width = 96, k_small_as_it_is = 160;
/// Seconds from the last moment of the search to the verdict's extra moments.
constexpr std::array k_later_moments{2.7, 23.4};
/// Share of the time budget for proofs of the hits.
constexpr double k_proof = 0.05;
/// Combinations that are measured at full size.
constexpr size_t k_judged = 3;
/// Pictures that the verdict draws in each view: of each setting, and of the truth's ladder in times of the
/// scene's own.
constexpr double k_drawn_of_setting = 5, k_drawn_of_truth = 60;
/// A truth in single precision is tried first if errors below this, RMSE, need not be distinguished.
constexpr double k_float_will_do = 1e-4;
/// Seconds that a step of a small truth may take while knobs are chosen.
constexpr double k_longest_trial = 3;
/// Gains below this are not worth a change.
constexpr double k_least_time_gain = 1.02;

struct Stage {
    double timing; ///< share of the time budget
    double step;   ///< longest step of the truth, as a share of the budget
    double end;    ///< end of everything, as a share of the budget; includes compilation and the truth
    size_t rounds;
};
constexpr Stage k_search{0.15, 0.05, 1, 7}, k_judgement{0.25, 0.1, 1.5, 15};

/// Returns the smallest threshold that the rounding of floats leaves meaningful: the scene's own, or a strict
/// one.
std::string threshold_for_floats(const QualitySetting& setting) {
    constexpr double k_strict = 2e-5;
    const Axis& axis = setting.axis;
    const std::string own = axis.values[std::min(setting.own, axis.values.size() - 1)];
    return number_of(own).value_or(0) > 4 * k_strict ? fmt::format("{}", k_strict) : own;
}

/// Returns the axes by which a truth becomes stricter. A step that is scaled down reaches less far, so its
/// scale is held unless the count of the march grows with it. In single precision thresholds are held where
/// floats still come to them.
std::vector<Axis> axes_of_truth(const std::vector<QualitySetting>& settings, bool in_double) {
    const bool counts = std::ranges::any_of(settings, [](const QualitySetting& each) {
        return each.march && each.role == QualitySetting::Role::bound;
    });
    std::vector<Axis> axes;
    for (const QualitySetting& each : settings)
        if (!in_double && each.role == QualitySetting::Role::threshold)
            axes.push_back({each.axis.name, {threshold_for_floats(each)}});
        else if (counts || each.role != QualitySetting::Role::step)
            axes.push_back(each.axis);
    return axes;
}

class Tuner {
public:
    Tuner(const scene::Scene& scene, TuneRequest request, const Watch& watch, const Circumstances& facts)
        : scene_(scene), request_(std::move(request)), watch_(watch), facts_(facts) {
        limited_ = watch_;
        limited_.keep_going = [this] {
            late_ = late_ || clock_.elapsed().wall * 1e-3 > end_ * request_.seconds;
            return !late_ && watch_.keep_going();
        };
    }

    Result<Tuned> run() {
        const WorkPrecisionSet explored = TRY(explore());
        auto found = candidates(explored, request_.settings, request_.goal, milliseconds(explored));
        found = TRY(screened(std::move(found)));
        std::vector<View> views = request_.views;
        for (const double later : k_later_moments)
            if (later == k_later_moments.front() || views.back().state.frame < 120 ||
                !render::may_have_feedback(scene_))
                views.push_back(unseen(request_.views.back(), later));
        const Extent extent = judged(explored, found.size(), views.size());
        Findings findings = TRY(measure(found, extent, views, k_judgement));
        if (const std::string why = blur(findings.set);
            !why.empty() && !request_.as_it_is && !by_hits() && request_.goal.most_error) {
            sentences_.push_back("the scene as it is takes the place of a reference: " + why);
            request_.as_it_is = true;
            findings = TRY(measure(found, extent, std::move(views), k_judgement));
        }
        Tuned tuned{{std::move(findings), {}}, {}};
        TRY(judge(tuned));
        return tuned;
    }

private:
    bool by_hits() const { return request_.goal.measure == Measure::wrong; }

    Study study(const std::vector<std::vector<Setting>>& points, Extent extent, std::vector<View> views,
                const Stage& stage) const {
        Study study = study_of(points, request_.settings);
        study.axes = axes_of_truth(request_.settings, in_double_);
        study.extent = extent;
        study.views = std::move(views);
        study.rays = by_hits(); // hits need a second program for every point
        study.longest_step = stage.step * request_.seconds;
        study.proof_seconds = by_hits() ? k_proof * request_.seconds : 0;
        study.enough = sharpness(request_.goal);
        study.promote = in_double_;
        study.first_step = first_step_;
        return study;
    }

    Timing timing(const Stage& stage) {
        const bool cpu = gl::is_software_renderer(facts_.renderer) && !request_.goal.most_milliseconds;
        return {2, stage.rounds, stage.timing * request_.seconds,
                [this](const WorkPrecisionSet& set) { return blur(set).empty(); }, cpu};
    }

    Error too_late() const {
        return {ErrorCode::check_failed,
                fmt::format("no result: {:g} seconds are too few for this scene: give more with --budget",
                            request_.seconds),
                {}};
    }

    /// Runs one study of these settings; results are discarded if the time ran out.
    Result<Findings> measure(const std::vector<std::vector<Setting>>& points, Extent extent,
                             std::vector<View> views, const Stage& stage) {
        const Study planned = study(points, extent, std::move(views), stage);
        end_ = stage.end;
        auto findings = request_.as_it_is ? compare(points, planned, timing(stage), limited_)
                                          : conduct(scene_, planned, timing(stage), limited_, facts_);
        if (late_)
            return fail(too_late());
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

    /// Returns the size of the verdict's pictures: the requested one, or a smaller one of the same shape if
    /// that would take longer than the time that is left.
    Extent judged(const WorkPrecisionSet& explored, size_t settings, size_t views) {
        const double left = k_judgement.end * request_.seconds - clock_.elapsed().wall * 1e-3;
        const double truth = request_.as_it_is ? 1 : k_drawn_of_truth;
        const double drawn = double(views) * (double(settings + 1) * k_drawn_of_setting + truth);
        const double needed = milliseconds(explored) * 1e-3 * drawn;
        if (request_.goal.most_milliseconds)
            return request_.extent;
        const Extent extent = affordable(request_.extent, needed, left, k_small_width);
        if (extent != request_.extent)
            sentences_.push_back(smaller_verdict(extent, request_.extent));
        return extent;
    }

    Extent small() const {
        return small_of(request_.extent, request_.as_it_is ? k_small_as_it_is : k_small_width);
    }

    /// Studies the single values. Without a truth for all settings, takes only those of the march; without
    /// one for them, the scene as it is becomes the truth if an error was given.
    Result<WorkPrecisionSet> explore() {
        if (by_hits())
            return explore_hits();
        TRY(find_truth());
        return sample(single_values(request_.settings));
    }

    Result<WorkPrecisionSet> explore_hits() {
        for (;;) {
            WorkPrecisionSet set =
                TRY(measure(single_values(request_.settings), small(), request_.views, k_search)).set;
            const std::string why = blur(set);
            if (why.empty())
                return set;
            if (!only_march() || !watch_.keep_going())
                return fail(ErrorCode::check_failed, "no result: " + why + without_truth());
            say_why_only_march(why);
        }
    }

    /// Drops all settings but those of the march; returns false if that leaves the same or none.
    bool only_march() {
        const size_t before = request_.settings.size();
        std::vector<QualitySetting> march = request_.settings;
        std::erase_if(march, [](const QualitySetting& each) { return !each.march; });
        if (march.empty() || march.size() == before)
            return false;
        request_.settings = std::move(march);
        return true;
    }

    void say_why_only_march(const std::string& why) {
        sentences_.push_back(
            "only the march's own settings were varied: for the others there is no reference (" + why + ")");
    }

    /// Finds small pictures to which the scene converges, in single precision if that is enough.
    Result<void> find_truth() {
        const double most = request_.goal.most_error.value_or(0);
        in_double_ = !(request_.goal.most_error && *sharpness(request_.goal) >= 0.999 * k_float_will_do);
        end_ = k_search.end;
        std::string why, march_why;
        while (!request_.as_it_is) {
            const Study planned = study({}, small(), request_.views, k_search);
            limited_.begin("the reference", 1);
            auto truth = converged_pictures(scene_, planned, limited_.keep_going);
            if (late_)
                return fail(too_late());
            if (!truth)
                return fail(std::move(truth.error()));
            WorkPrecisionSet set;
            set.picture_standard = truth->standard;
            why = request_.goal.most_error ? blur_of(set, request_.goal.measure, most) : truth->standard.none;
            if (why.empty()) {
                first_step_ = std::max(0, truth->step - 2);
                truth_ = *std::move(truth);
                return {};
            }
            if (!in_double_ && truth->standard.none.empty()) {
                in_double_ = true;
                continue;
            }
            if (only_march()) {
                march_why = why;
                continue;
            }
            if (!request_.goal.most_error || !watch_.keep_going())
                return fail(ErrorCode::check_failed, "no result: " + why + without_truth());
            sentences_.push_back("the scene as it is takes the place of a reference: " + why);
            request_.as_it_is = true;
            std::ranges::for_each(request_.settings, leave_out_stricter);
            std::erase_if(request_.settings,
                          [](const QualitySetting& each) { return each.axis.values.size() < 2; });
        }
        if (!march_why.empty())
            say_why_only_march(march_why);
        if (request_.settings.empty())
            return fail(ErrorCode::check_failed, "no result: " + why);
        return {};
    }

    /// Measures settings on small pictures, drawn by one program with uniforms if the driver takes it.
    Result<WorkPrecisionSet> sample(const std::vector<std::vector<Setting>>& points) {
        WorkPrecisionSet set;
        set.study = study(points, small(), request_.views, k_search);
        set.circumstances = facts_;
        set.picture_standard = request_.as_it_is ? Standard{"the scene as it is", 0.0, ""} : truth_.standard;
        for (Point& point : points_of(set.study))
            set.points.emplace_back().point = std::move(point);
        TurnedSpecimen specimen(scene_, small(), HitSource::none);
        const std::vector<Setting> first =
            points.empty() ? std::vector<Setting>{} : own_values(request_.settings);
        if (auto made = specimen.at(first, glsl::Precision::single); !made)
            return fail(std::move(made.error()));
        if (!specimen.has_uniforms() && !points.empty()) // every setting is another program
            return TRY(measure(points, small(), request_.views, k_search)).set;
        const auto settings_of = [&](const WorkPrecision& point) {
            std::vector<Setting> all = first;
            all.insert(all.end(), point.point.settings.begin(), point.point.settings.end());
            return merged(all);
        };
        Truth truth{truth_.views, truth_.blind, {}, {}};
        std::vector<Sight> sights;
        limited_.begin("settings tried", set.points.size());
        for (WorkPrecision& point : set.points) {
            if (!limited_.keep_going())
                return fail(late_ ? too_late() : Error{ErrorCode::check_failed, "interrupted", {}});
            Sight& sight = sights.emplace_back();
            auto turned = specimen.at(settings_of(point), glsl::Precision::single);
            limited_.advance();
            if (!turned) {
                point.failure = to_string(turned.error());
                continue;
            }
            sight.pictures = (*turned)->pictures(set.study.views);
            if (request_.as_it_is && truth.pictures.empty())
                truth = TRY(truth_of(sight.pictures));
            if (request_.as_it_is)
                sight.pictures = as_shown(std::move(sight.pictures));
            for (size_t view = 0; view < set.study.views.size(); ++view)
                point.views.push_back(outcome_of(sight, truth, view));
            point.all = outcome_of_all(sight, truth, point.views);
        }
        time_points(
            timing(k_search), limited_,
            [&](size_t point, size_t view, bool ask_gpu) {
                return specimen.at(settings_of(set.points[point]), glsl::Precision::single)
                    .value()
                    ->time(set.study.views[view], ask_gpu);
            },
            set);
        if (late_)
            return fail(too_late());
        return set;
    }

    /// Returns the scene's own values of the settings, which become uniforms together.
    std::vector<Setting> own_values(const std::vector<QualitySetting>& settings) const {
        std::vector<Setting> own;
        for (const QualitySetting& each : settings)
            own.push_back({each.axis.name, value_of(scene_, each.axis.name)});
        return own;
    }

    /// Returns the combinations that are worth full size: of those that keep the error on small pictures the
    /// fastest ones, and the most exact one.
    Result<std::vector<std::vector<Setting>>> screened(std::vector<std::vector<Setting>> found) {
        if (by_hits() || request_.goal.most_milliseconds || found.size() <= 1)
            return found;
        const WorkPrecisionSet set = TRY(sample(found));
        const double most = most_error(set);
        const Measure measure = request_.goal.measure;
        std::vector<const WorkPrecision*> points;
        for (const WorkPrecision& point : set.points)
            if (&point != &set.points.front() && point.timed())
                points.push_back(&point);
        std::ranges::sort(points, {}, [&](const WorkPrecision* point) {
            return std::pair(!(largest_error(set, *point, measure) <= most), point->all.time().median);
        });
        std::vector<std::vector<Setting>> kept;
        for (const WorkPrecision* point : points)
            if (kept.size() < k_judged)
                kept.push_back(point->point.settings);
        const auto exact = std::ranges::min_element(
            points, {}, [&](const WorkPrecision* point) { return error_by(measure, point->all); });
        if (exact != points.end() && std::ranges::find(kept, (*exact)->point.settings) == kept.end())
            kept.back() = (*exact)->point.settings;
        return kept;
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
        if (best && best != &own && is_better(set, *best, own, most)) {
            tuned.chosen = best->point.settings;
            sentences_.push_back("chosen: " + best->point.label + ": " + facts_of(set, *best));
            if (const auto gain = speedup(own, *best))
                sentences_.push_back(fmt::format("{:.2f} x [{:.2f}, {:.2f}] as fast as unchanged",
                                                 gain->ratio, gain->confidence.low, gain->confidence.high));
        } else if (const WorkPrecision* open = undecided(set, own, most)) {
            sentences_.push_back(fmt::format(
                "cannot tell whether {} keeps {}: its error may be from {} to {}; a larger error is decided",
                open->point.label, to_string(goal), figure(least_error(set, *open, goal.measure)),
                figure(largest_error(set, *open, goal.measure))));
        } else if (!best) {
            sentences_.push_back("no measured setting keeps " + to_string(goal));
        } else {
            sentences_.push_back("no measured setting is measurably better and keeps " + to_string(goal));
        }
        tuned.sentences = std::move(sentences_);
        return {};
    }

    /// Returns a faster point that may or may not keep the error, because the truth's own error is too large.
    const WorkPrecision* undecided(const WorkPrecisionSet& set, const WorkPrecision& own, double most) const {
        const Goal& goal = request_.goal;
        if (!goal.most_error)
            return nullptr;
        for (const WorkPrecision& point : set.points) {
            if (&point == &own || !may_be_chosen(point))
                continue;
            const auto gain = speedup(own, point);
            const double error = error_by(goal.measure, point.all), off = own_error(set, goal.measure);
            if (gain && gain->confidence.low > k_least_time_gain && error - off <= most && error + off > most)
                return &point;
        }
        return nullptr;
    }

    std::string facts_of(const WorkPrecisionSet& set, const WorkPrecision& point) const {
        const Measure measure = request_.goal.measure;
        return fmt::format("{}{}, {} {}{}", cost_of(point), point.all.by_cpu ? " of CPU time" : "",
                           to_string(Goal{measure}), figure(error_by(measure, point.all)),
                           work_of(set.study, point.point.settings));
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
    bool is_better(const WorkPrecisionSet& set, const WorkPrecision& best, const WorkPrecision& own,
                   double most) const {
        const Measure measure = request_.goal.measure;
        if (const auto& time = request_.goal.most_milliseconds)
            return own.all.time().median > *time || error_by(measure, best.all) < error_by(measure, own.all);
        const auto gain = speedup(own, best);
        return least_error(set, own, measure) > most ||
               (gain && gain->confidence.low > 1 && gain->ratio >= k_least_time_gain);
    }

    const scene::Scene& scene_;
    TuneRequest request_;
    const Watch& watch_;
    Watch limited_; ///< also ends when the time is spent
    const Circumstances& facts_;
    const Stopwatch clock_{};
    double end_ = 1; ///< share of the budget at which the present stage ends
    bool late_ = false;
    PictureTruth truth_{}; ///< small; empty: the scene as it is
    bool in_double_ = true;
    int first_step_ = 0; ///< of the full-size truth's ladder
    std::vector<std::string> sentences_;
};

} // namespace

Result<ChosenKnobs> choose_knobs(const scene::Scene& scene, std::vector<QualitySetting> settings,
                                 const Study& study, const KeepGoing& keep_going) {
    ChosenKnobs chosen;
    std::vector<QualitySetting> march = settings;
    std::erase_if(march, [](const QualitySetting& each) { return !each.march; });
    std::vector<std::vector<QualitySetting>> tries{std::move(settings)};
    if (!march.empty() && march.size() < tries.front().size())
        tries.push_back(std::move(march));
    for (std::vector<QualitySetting>& each : tries) {
        Study small = study_of({}, each);
        small.extent = small_of(study.extent, k_small_width);
        small.views = study.views;
        small.rays = false;
        small.longest_step = k_longest_trial;
        for (const bool in_double : {false, true}) {
            small.promote = in_double;
            small.axes = axes_of_truth(each, in_double);
            const auto truth = converged_pictures(scene, small, keep_going);
            if (truth && truth->standard.none.empty() && truth->standard.uncertainty)
                return ChosenKnobs{each, axes_of_truth(each, true), false, std::move(chosen.why)};
            chosen.why = truth ? truth->standard.none : to_string(truth.error());
        }
    }
    chosen.settings = std::move(tries.front());
    std::ranges::for_each(chosen.settings, leave_out_stricter);
    std::erase_if(chosen.settings, [](const QualitySetting& each) { return each.axis.values.size() < 2; });
    chosen.as_it_is = true;
    return chosen;
}

Result<Tuned> tune(const scene::Scene& scene, TuneRequest request, const Watch& watch,
                   const Circumstances& circumstances) {
    return Tuner(scene, std::move(request), watch, circumstances).run();
}

std::optional<MarchPlaces> march_places(const scene::Scene& scene) {
    const auto function = PassFunction::create(scene, scene.image());
    if (!function || function->loops().empty())
        return std::nullopt;
    const proof::MarchingLoop& loop = function->loops().front();
    const auto& instructions = function->function().instructions;
    MarchPlaces places{function->locate(loop.line)};
    for (const proof::Carried& carried : loop.carried)
        if (carried.update != proof::k_no_value)
            places.steps.push_back(function->locate(instructions[carried.update].line));
    if (loop.far != proof::k_no_value && instructions[loop.far].op == proof::Op::constant &&
        instructions[loop.far].type == proof::Scalar::real)
        places.far = std::bit_cast<float>(instructions[loop.far].immediate);
    return places;
}

} // namespace tidemark::lab
