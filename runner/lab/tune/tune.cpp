#include "lab/tune/tune.hpp"

#include "base/try.hpp"
#include "lab/march/pass_function.hpp"
#include "lab/stopwatch.hpp"
#include "lab/study/scene_comparison.hpp"
#include "lab/study/specimen.hpp"
#include "lab/study/verdict.hpp"
#include "lab/tune/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>

namespace tidemark::lab {
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
    double step; ///< longest step of the truth, as a share of the budget
    double end; ///< end of everything, as a share of the budget; includes compilation and the truth
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
                fmt::format("cannot say: {:g} seconds are too few for this scene: give more with --for",
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
                return fail(ErrorCode::check_failed, "cannot say: " + why + without_truth());
            sentences_.push_back(
                "only the march's own settings were turned: with the others there is no truth (" + why + ")");
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
                   : "; --as-it-is tells how much faster it can show what it shows now";
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
            return fail(ErrorCode::check_failed, "cannot say: " + why + without_truth());
        sentences_.push_back("as it is: " + facts_of(set, own));
        const WorkPrecision* best = best_by(set, goal);
        if (!goal.most_milliseconds)
            goal.most_error = most;
        if (!best)
            sentences_.push_back("nothing that was measured keeps " + to_string(goal));
        else if (best == &own || !is_better(*best, own, most))
            sentences_.push_back("nothing that was measured is better beyond noise and keeps " +
                                 to_string(goal));
        else {
            tuned.chosen = best->point.settings;
            sentences_.push_back("chosen: " + best->point.label + ": " + facts_of(set, *best));
            if (const auto gain = speedup(own, *best))
                sentences_.push_back(fmt::format("{:.2f} x [{:.2f}, {:.2f}] as fast as it is", gain->ratio,
                                                 gain->confidence.low, gain->confidence.high));
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
