#include "lab/simplify.hpp"

#include "base/error.hpp"
#include "lab/conduct.hpp"
#include "lab/pass_function.hpp"
#include "lab/probe_inputs.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/work_precision.hpp"
#include "render/frame_plan.hpp"
#include "render/frame_stepper.hpp"
#include "render/gl_context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace tidemark::lab {
namespace {

/// Longer side of the search pictures; for cuts that depend on the size, of finer ones.
constexpr int k_small = 128, k_fine = 512, k_smallest = 64;
/// The smallest pictures are used for the program with switches if those of `k_small` would take more than
/// this share of the time budget.
constexpr double k_slow_screening = 0.15;
/// The finer pictures are used if one trial takes at most this share of the time budget.
constexpr double k_fine_trial = 0.1;
/// Shares of the time budget: `k_looking`, `k_alone` and `k_together` end the search for places and the
/// trials of cuts alone and together; `k_timing` is for the verdict.
constexpr double k_looking = 0.2, k_screened = 0.5, k_alone = 0.6, k_together = 0.7, k_timing = 0.25,
                 k_others = 0.03; ///< `k_others` is for drawing the other views once
/// A program that shows the values of expressions takes at most about so many times as long to compile as the
/// scene itself.
constexpr double k_showing_compile = 4;
/// A program with switches takes about so many times as long to compile as the scene itself.
constexpr double k_switched_compile = 2;
/// Limit of the cuts in one program with switches.
constexpr size_t k_switched_together = 32;
/// Weight of the estimated work beside the measured time of a switched cut.
constexpr double k_estimated = 0.5;
/// A combination is as fast as another one if it takes at most this share of its time.
constexpr double k_as_fast = 1.02;
/// The verdict's pictures are made smaller if everything would else take more than this share of the budget.
constexpr double k_everything = 1.1;
/// The verdict's rounds end at this share of the budget if other work of the machine slows them down.
constexpr double k_last = 1.2;
/// The least share of the budget that the verdict's rounds get.
constexpr double k_least_timing = 0.1;
/// Savings of single cuts that differ by less than this count as equal.
constexpr double k_same_saving = 0.05;
/// Share of the allowed error that the search may use: moments it did not see rarely have as little error as
/// those it did.
constexpr double k_error_margin = 0.8;
/// Limit of the combinations that are judged at full size, and the least number of rounds for each.
constexpr size_t k_most_knob_steps = 6, k_fewest_rounds = 9;
/// Moments that the search does not use: seconds after its last moment, as a share of that moment's time, but
/// at least of one second.
constexpr double k_later[] = {0.087, 0.423, 1.53};

std::vector<glsl::Cure> changes_of(const std::vector<ChosenCut>& cuts) {
    std::vector<glsl::Cure> changes;
    for (const ChosenCut& cut : cuts)
        changes.push_back(cut.change);
    return changes;
}

class Simplifier {
public:
    Simplifier(const scene::Scene& scene, const SimplifyRequest& request, const Watch& watch,
               const Circumstances& facts)
        : scene_(scene), request_(request), watch_(watch), facts_(facts), searched_(request.goal) {
        *searched_.most_error *= k_error_margin;
    }

    Result<Simplified> run() {
        const Extent small = small_of(request_.extent, k_small);
        auto bench = TRY(CutBench::create(scene_, small, request_.views, k_others * request_.seconds));
        longest_trial_ = bench.compile_seconds();
        CutPlaces places = TRY(find_cuts(scene_, request_.views, small, [&] {
            return goes_on(k_looking, k_showing_compile * bench.compile_seconds());
        }));
        std::erase_if(places.cuts,
                      [&](const glsl::Cut& cut) { return !request_.can_be_written(cut.change); });
        auto fine = fine_bench(bench, places.cuts);
        CutBench& finer = fine ? *fine : bench;
        known_ = places.cuts.size();
        auto coarse = coarse_bench(bench, places.cuts.size());
        CutBench& screening = coarse ? *coarse : bench;
        const auto order =
            screen(screening, coarse ? small_of(request_.extent, k_smallest) : small, places.cuts);
        try_all(bench, screening, places.cuts);
        try_alone(bench, finer, places.cuts, order);
        others_ = bench.other_view_count();
        combine(std::ranges::any_of(good_, &ChosenCut::hangs_on_size) ? finer : bench);
        std::ranges::stable_sort(way_, std::greater<>(), &Step::time);
        Simplified found{{TRY(judge(bench)), {}}, {}};
        choose(found, std::move(places.left));
        return found;
    }

private:
    double seconds() const { return clock_.elapsed().wall * 1e-3; }

    /// Returns whether work that takes `needed` seconds ends within that part of the time budget.
    bool goes_on(double part, double needed = 0) const {
        return watch_.keep_going() && seconds() + needed < part * request_.seconds;
    }

    std::optional<CutTrial> tried(CutBench& bench, std::span<const glsl::Cure> cuts, Specimen& other,
                                  bool everywhere = true) {
        const double before = seconds();
        auto trial = bench.try_cuts(cuts, other, searched_, everywhere);
        longest_trial_ = std::max(longest_trial_, seconds() - before);
        return trial;
    }

    bool keeps(double error) const { return error <= *request_.goal.most_error; }

    /// Returns a bench for the finer pictures; nullopt if no cut needs it, or if it is too slow.
    std::optional<CutBench> fine_bench(CutBench& bench, const std::vector<glsl::Cut>& cuts) const {
        const Extent fine = small_of(request_.extent, k_fine);
        const double trial = bench.seconds_of_trial() * larger(fine);
        if (std::ranges::none_of(cuts, &glsl::Cut::hangs_on_size) || trial > k_fine_trial * request_.seconds)
            return std::nullopt;
        auto made = CutBench::create(scene_, fine, request_.views, k_others * request_.seconds);
        return made ? std::optional(*std::move(made)) : std::nullopt;
    }

    /// Returns a bench with the smallest pictures for the program with switches; nullopt if the scene is fast
    /// enough without.
    std::optional<CutBench> coarse_bench(const CutBench& bench, size_t cuts) const {
        if (bench.draw_seconds() * double(request_.views.size() * cuts) < k_slow_screening * request_.seconds)
            return std::nullopt;
        auto made = CutBench::create(scene_, small_of(request_.extent, k_smallest), request_.views, 0);
        return made ? std::optional(*std::move(made)) : std::nullopt;
    }

    /// Returns the ratio of pixels to those of the search pictures.
    double larger(Extent extent) const {
        return double(extent.pixels()) / double(small_of(request_.extent, k_small).pixels());
    }

    /// Returns whether a trial of the cut's family makes its own superfluous: one as strong or weaker changed
    /// the picture too much, or one as strong or stronger kept it.
    bool is_decided(const glsl::Cut& cut) const {
        const auto known = families_.find(cut.family);
        return known != families_.end() &&
               (cut.strength <= known->second.kept || cut.strength >= known->second.refused);
    }

    void remember(const glsl::Cut& cut, bool kept) {
        Family& family = families_[cut.family];
        if (kept)
            family.kept = std::max(family.kept, cut.strength);
        else
            family.refused = std::min(family.refused, cut.strength);
    }

    /// A cut that keeps the picture by the switched program.
    struct Screened {
        size_t cut = 0;
        size_t program = 0; ///< index into `switches_`
        double error = 0;
        double promise = 0; ///< rough share of the time that it saves
    };

    /// Draws the cuts that have a switched form with few programs, and keeps in `screened_` those that stay
    /// within the goal. Returns the order in which to try cuts alone: these first, then those that were not
    /// drawn.
    std::vector<size_t> screen(CutBench& bench, Extent extent, const std::vector<glsl::Cut>& cuts) {
        std::vector<size_t> candidates;
        for (size_t i = 0; i < cuts.size(); ++i)
            if (!cuts[i].switched.empty())
                candidates.push_back(i);
        watch_.begin("cuts screened", candidates.size());
        std::vector<bool> seen(cuts.size());
        double needed = k_switched_compile * bench.compile_seconds();
        for (size_t first = 0; first < candidates.size() && goes_on(k_screened, needed);
             first += k_switched_together) {
            const auto from = candidates.begin() + std::ptrdiff_t(first);
            const size_t count = std::min(k_switched_together, candidates.size() - first);
            const double before = seconds();
            auto switches = CutSwitches::create(scene_, extent, cuts, {from, from + std::ptrdiff_t(count)},
                                                [&] { return goes_on(k_screened, needed); });
            if (!switches || !bench.take_as_reference(*switches, searched_))
                continue;
            needed = seconds() - before;
            switches_.push_back(*std::move(switches));
            screen_those(bench, cuts, seen);
        }
        std::ranges::stable_sort(screened_, std::greater<>(), &Screened::promise);
        put_stronger_first(cuts);
        std::vector<size_t> order;
        for (const Screened& each : screened_)
            order.push_back(each.cut);
        for (size_t i = 0; i < cuts.size(); ++i)
            if (!seen[i])
                order.push_back(i);
        return order;
    }

    /// Exchanges the cuts of each family, so that a stronger one comes before a weaker one.
    void put_stronger_first(const std::vector<glsl::Cut>& cuts) {
        for (size_t i = 0; i < screened_.size(); ++i)
            for (size_t k = i + 1; k < screened_.size(); ++k) {
                const glsl::Cut &one = cuts[screened_[i].cut], &other = cuts[screened_[k].cut];
                if (!one.family.empty() && one.family == other.family && one.strength < other.strength)
                    std::swap(screened_[i], screened_[k]);
            }
    }

    /// Draws the cuts of the last program.
    void screen_those(CutBench& bench, const std::vector<glsl::Cut>& cuts, std::vector<bool>& seen) {
        double most = 1;
        for (const glsl::Cut& cut : cuts)
            most = std::max(most, cut.work);
        for (const size_t i : switches_.back().which()) {
            if (!goes_on(k_screened))
                return;
            watch_.advance();
            const auto known = families_.find(cuts[i].family);
            const bool hopeless = known != families_.end() && cuts[i].strength >= known->second.refused;
            const auto error = hopeless
                                   ? std::nullopt
                                   : bench.error_of_switched(switches_.back(), std::span(&i, 1), searched_);
            seen[i] = true;
            if (error) {
                const double saved = std::max(0.0, 1 - bench.time_of_switched(switches_.back(), i));
                screened_.push_back(
                    {i, switches_.size() - 1, *error, saved + k_estimated * cuts[i].work / most});
                continue;
            }
            tried_ += !hopeless;
            refused_ += !hopeless;
            if (!cuts[i].family.empty())
                remember(cuts[i], false);
        }
    }

    /// Returns whether `cut` is inside the text of another one, which is not the same text.
    static bool is_gone(const ChosenCut& cut, const std::vector<ChosenCut>& others) {
        return std::ranges::any_of(others, [&](const ChosenCut& other) {
            return !is_inside(other.change, cut.change) && is_inside(cut.change, other.change);
        });
    }

    /// Returns as many of the screened cuts as keep the goal together, by their switched programs.
    std::vector<ChosenCut> all_that_keep(CutBench& bench, const std::vector<glsl::Cut>& cuts) {
        std::vector<Screened> order = screened_;
        std::ranges::stable_sort(order, {}, [](const Screened& each) { return each.error > 0; });
        std::vector<ChosenCut> chosen;
        std::vector<std::vector<size_t>> made(switches_.size());
        std::vector<double> errors(switches_.size());
        std::set<std::string> families;
        for (const Screened& each : order) {
            const glsl::Cut& cut = cuts[each.cut];
            const ChosenCut next{cut.change, each.error, std::numeric_limits<double>::quiet_NaN()};
            if ((!cut.family.empty() && families.contains(cut.family)) || is_gone(next, chosen) ||
                std::ranges::any_of(
                    chosen, [&](const ChosenCut& other) { return is_inside(other.change, next.change); }))
                continue;
            if (!goes_on(k_alone))
                break;
            made[each.program].push_back(each.cut);
            const auto error =
                bench.error_of_switched(switches_[each.program], made[each.program], searched_);
            const double others = std::accumulate(errors.begin(), errors.end(), 0.0) - errors[each.program];
            if (!error || others + *error > *searched_.most_error) {
                made[each.program].pop_back();
                continue;
            }
            errors[each.program] = *error;
            families.insert(cut.family);
            chosen.push_back(next);
        }
        return chosen;
    }

    /// Tries all cuts that keep the goal together: one program may save what each of them saves.
    void try_all(CutBench& bench, CutBench& screening, const std::vector<glsl::Cut>& cuts) {
        if (screened_.empty())
            return;
        std::vector<std::vector<ChosenCut>> left{all_that_keep(screening, cuts)};
        while (!left.empty() && goes_on(k_alone, longest_trial_)) {
            const std::vector<ChosenCut> part = std::move(left.back());
            left.pop_back();
            if (part.size() < 2)
                continue;
            const auto trial = tried(bench, changes_of(part), bench.own());
            if (trial && trial->time <= k_pays)
                way_.push_back({part, trial->time});
            if (trial)
                continue;
            const auto middle = part.begin() + std::ptrdiff_t(part.size() / 2);
            left.emplace_back(middle, part.end());
            left.emplace_back(part.begin(), middle);
        }
    }

    /// Returns whether a combination has the cut: the other views have been drawn with it.
    bool is_on_way(const glsl::Cure& cut) const {
        return std::ranges::any_of(way_, [&](const Step& step) {
            return std::ranges::find(step.cuts, cut, &ChosenCut::change) != step.cuts.end();
        });
    }

    void try_alone(CutBench& bench, CutBench& finer, const std::vector<glsl::Cut>& cuts,
                   const std::vector<size_t>& order) {
        watch_.begin("cuts tried", order.size());
        for (const size_t i : order) {
            const glsl::Cut& cut = cuts[i];
            // Time to combine and to judge is needed only if something was found.
            if (!goes_on(good_.empty() && way_.empty() ? k_together : k_alone) ||
                !goes_on(k_together, longest_trial_))
                break;
            watch_.advance();
            if (is_decided(cut))
                continue;
            ++tried_;
            CutBench& own = cut.hangs_on_size ? finer : bench;
            const auto trial = tried(own, std::span(&cut.change, 1), own.own(), !is_on_way(cut.change));
            refused_ += !trial;
            if (!cut.family.empty())
                remember(cut, trial.has_value());
            if (trial && trial->time <= k_pays)
                good_.push_back({cut.change, trial->error, trial->time, cut.hangs_on_size});
            else
                useless_.push_back(cut.change);
        }
        // Cuts without any visible error come first; among those that save as much, the one with more work.
        // Then come those that save the most for their error.
        std::ranges::stable_sort(good_, std::greater<>(), [](const ChosenCut& cut) {
            const double saved = 1 - cut.time;
            return cut.error == 0 ? std::pair(true, std::round(saved / k_same_saving))
                                  : std::pair(false, saved / cut.error);
        });
    }

    /// Adds one cut after another, as long as the error stays within the goal.
    void combine(CutBench& bench) {
        watch_.begin("cuts combined", good_.size());
        if (good_.empty() || combine_all(bench))
            return;
        if (!is_on_way(good_.front().change)) // tried everywhere
            way_.push_back({{good_.front()}, good_.front().time});
        double best = good_.front().time;
        std::vector<ChosenCut> last{good_.front()};
        for (const ChosenCut& cut : std::span(good_).subspan(1)) {
            watch_.advance();
            if (!goes_on(k_together))
                break;
            std::vector<ChosenCut> next = last;
            if (is_gone(cut, next))
                continue;
            add(next, cut);
            const auto trial = tried(bench, changes_of(next), bench.own());
            if (!trial || trial->time > k_pays * best)
                continue;
            best = trial->time;
            last = next;
            way_.push_back({std::move(next), best});
        }
    }

    /// Adds the cut in the place of those inside it.
    static void add(std::vector<ChosenCut>& cuts, const ChosenCut& cut) {
        std::erase_if(cuts, [&](const ChosenCut& other) { return is_inside(other.change, cut.change); });
        cuts.push_back(cut);
    }

    /// Tries one combination: the cuts that pay alone, and those of the fastest combination so far that were
    /// not timed alone. Returns whether it is as fast as any other; then the longer way is not needed.
    bool combine_all(CutBench& bench) {
        std::vector<ChosenCut> all;
        const auto best = std::ranges::min_element(way_, {}, &Step::time);
        if (best != way_.end())
            for (const ChosenCut& cut : best->cuts)
                if (std::ranges::find(useless_, cut.change) == useless_.end() &&
                    std::ranges::find(good_, cut.change, &ChosenCut::change) == good_.end())
                    all.push_back(cut);
        for (const ChosenCut& cut : good_)
            if (!is_gone(cut, all))
                add(all, cut);
        if (all.size() < 2 || !goes_on(k_together, longest_trial_))
            return false;
        const auto trial = tried(bench, changes_of(all), bench.own());
        double limit = good_.front().time;
        if (best != way_.end())
            limit = std::min(limit, best->time);
        if (!trial || trial->time > k_as_fast * limit)
            return false;
        way_.clear(); // others have cuts that save nothing
        way_.push_back({std::move(all), trial->time});
        return true;
    }

    /// Returns the seconds that are left up to a share of the budget to time the verdict's pictures, after
    /// two programs were compiled.
    double seconds_left(double share) const {
        return std::max(share * request_.seconds - seconds() - 2 * longest_trial_,
                        k_least_timing * request_.seconds);
    }

    /// Returns the size of the verdict's pictures: the requested one, or a smaller one of the same shape if
    /// `seconds_a_round`, for one point at the requested size, does not allow two points.
    Extent judged_extent(double seconds_a_round) const {
        return affordable(request_.extent, 2 * double(k_fewest_rounds) * seconds_a_round,
                          seconds_left(k_everything), k_small);
    }

    /// Returns the last step and others evenly spaced before it, as many as the time allows.
    std::vector<size_t> judged_steps(double seconds_a_round) const {
        std::vector<size_t> steps;
        const double points =
            k_timing * request_.seconds / (double(k_fewest_rounds) * seconds_a_round + longest_trial_);
        const auto affordable = size_t(std::clamp(points - 1, 1.0, double(k_most_knob_steps)));
        const size_t count = std::min(way_.size(), affordable);
        for (size_t i = 1; i <= count; ++i)
            steps.push_back(way_.size() * i / count - 1);
        return steps;
    }

    Result<Findings> judge(CutBench& bench) {
        const double whole = bench.milliseconds() * 1e-3 * larger(request_.extent) *
                             double(request_.views.size() + std::size(k_later));
        judged_ = judged_extent(whole);
        const double round = whole * double(judged_.pixels()) / double(request_.extent.pixels());
        steps_ = judged_steps(round);
        std::vector<std::pair<std::string, scene::Scene>> scenes;
        for (const size_t step : steps_)
            if (auto scene = changed(scene_, changes_of(way_[step].cuts)))
                scenes.emplace_back(fmt::format("step {}: {} cut{}", step + 1, way_[step].cuts.size(),
                                                way_[step].cuts.size() == 1 ? "" : "s"),
                                    *std::move(scene));
        Study study;
        study.about = "Cuts in the scene's text, compared with the unchanged scene.";
        study.extent = judged_;
        study.views = request_.views;
        const View& last = request_.views.back();
        for (const double later : k_later)
            study.views.push_back(unseen(last, later * std::max(last.state.seconds(), 1.0)));
        const double needed = double(k_fewest_rounds * (steps_.size() + 1)) * round;
        Timing timing{steps_.empty() ? size_t(0) : size_t(2), steps_.empty() ? size_t(3) : size_t(30),
                      std::min(std::max(2 * needed, k_timing * request_.seconds), seconds_left(k_last))};
        timing.by_cpu = gl::is_software_renderer(facts_.renderer); // other work of the machine does not count
        Watch watch = watch_;
        if (!watch_.keep_going()) // a cancelled search still judges its results
            watch.keep_going = [] { return true; };
        return compare_scenes(scene_, scenes, study, timing, watch, facts_);
    }

    bool keeps_parts(const Findings& findings, size_t point) const {
        const Evidence& seen = findings.evidence;
        for (size_t view = 0; view < seen.reference.size(); ++view)
            if (!lab::keeps_parts(request_.goal, seen.reference[view], seen.pictures[point][view]))
                return false;
        return true;
    }

    /// Returns the largest error of all views: a better view does not compensate for a worse one.
    double worst(const WorkPrecision& point) const {
        double worst = 0;
        for (const Outcome& view : point.views) {
            const double error = error_by(request_.goal.measure, view);
            worst = std::isnan(error) ? error : std::max(worst, error);
            if (std::isnan(worst))
                break;
        }
        return worst;
    }

    std::string cost_and_error(const WorkPrecision& point) const {
        return fmt::format("{}{}, {} {}", cost_of(point), point.all.by_cpu ? " of CPU time" : "",
                           to_string(Goal{request_.goal.measure}), figure(worst(point)));
    }

    void choose(Simplified& found, std::vector<std::string> left) const {
        const auto& points = found.findings.set.points;
        auto& say = found.sentences;
        say = std::move(left);
        say.push_back(fmt::format("{} of {} cuts were tried alone: {} save time and keep {}, also at {} "
                                  "other moments and places of the mouse",
                                  tried_, known_, good_.size(), to_string(request_.goal), others_));
        if (judged_ != request_.extent)
            say.push_back(smaller_verdict(judged_, request_.extent));
        say.push_back("unchanged: " + cost_and_error(points.front()));
        const WorkPrecision* best = nullptr;
        for (size_t i = 1; i < points.size(); ++i) {
            const WorkPrecision& point = points[i];
            say.push_back(fmt::format("{}: {}", point.point.label,
                                      point.measured() ? cost_and_error(point) : point.failure));
            const auto gain = speedup(points.front(), point);
            const bool may = point.timed() && keeps(worst(point)) && keeps_parts(found.findings, i) && gain &&
                             gain->confidence.low > 1;
            if (!may || (best && best->all.time().median <= point.all.time().median))
                continue;
            best = &point;
            found.chosen = way_[steps_[i - 1]].cuts;
        }
        if (!best) {
            say.push_back("no cut is measurably faster and keeps " + to_string(request_.goal) +
                          " in every view");
            if (good_.empty() && tried_ > 0)
                say.push_back(
                    fmt::format("{} of those tried change the picture more or do not compile, {} save "
                                "too little{}",
                                refused_, tried_ - refused_,
                                tried_ < known_ ? "; a longer --budget tries the others" : ""));
            return;
        }
        const auto gain = speedup(points.front(), *best);
        say.push_back(
            fmt::format("chosen: {}: {:.2f} x [{:.2f}, {:.2f}] as fast as unchanged, {} {} in the worst view",
                        best->point.label, gain->ratio, gain->confidence.low, gain->confidence.high,
                        to_string(Goal{request_.goal.measure}), figure(worst(*best))));
        say.push_back(work_sentence(found.chosen));
    }

    /// Reports the operation counts, which do not depend on the machine.
    std::string work_sentence(const std::vector<ChosenCut>& chosen) const {
        const auto before = work_of(scene_);
        const auto scene = changed(scene_, changes_of(chosen));
        const auto after = scene ? work_of(*scene) : fail(ErrorCode::load, "");
        if (!before || !after)
            return "its operations are not counted: " + to_string((before ? after : before).error());
        return fmt::format("{:.0f} operations a pixel instead of {:.0f} (of {}, counted in the text on "
                           "{} and {} pixels of {})",
                           after->operations, before->operations,
                           scene_.passes.size() == 1 ? scene_.image().name : "all passes", after->pixels,
                           before->pixels, request_.views.front().name);
    }

    /// Sums one pixel of each pass; `pixels` is that of the pass with the fewest counted.
    Result<PixelWork> work_of(const scene::Scene& scene) const {
        auto renderer = TRY(
            render::Renderer::create(scene, {.extent = request_.extent, .samples = image::SampleType::f32}));
        const render::FrameState state = state_of(request_.views.front(), request_.extent);
        render::FrameStepper(renderer, state).draw(state.frame);
        PixelWork sum{0, std::numeric_limits<size_t>::max()};
        for (const render::PlannedPass& planned : renderer.plan().passes) {
            const PixelWork work = TRY(count_work(renderer, planned.pass, inputs_of(state)));
            sum = {sum.operations + work.operations, std::min(sum.pixels, work.pixels)};
        }
        return sum;
    }

    struct Step {
        std::vector<ChosenCut> cuts;
        double time = 1; ///< as a share of the unchanged scene's
    };

    /// The strongest cut of a family that kept the picture, and the weakest that did not.
    struct Family {
        double kept = -std::numeric_limits<double>::infinity();
        double refused = std::numeric_limits<double>::infinity();
    };

    const scene::Scene& scene_;
    const SimplifyRequest& request_;
    const Watch& watch_;
    const Circumstances& facts_;
    Goal searched_; ///< goal for the search pictures
    Stopwatch clock_{};
    size_t tried_ = 0, known_ = 0, others_ = 0;
    size_t refused_ = 0;       ///< of the tried ones: they change the picture, or the driver rejects them
    double longest_trial_ = 0; ///< seconds
    Extent judged_{};          ///< size of the verdict's pictures
    std::map<std::string, Family> families_{};
    std::vector<ChosenCut> good_{};     ///< cuts that pay alone
    std::vector<glsl::Cure> useless_{}; ///< cuts that were timed alone or refused, and do not pay
    std::vector<CutSwitches> switches_{};
    std::vector<Screened> screened_{}; ///< those that promise the most first
    std::vector<Step> way_{};          ///< combinations; each keeps the error
    std::vector<size_t> steps_{};      ///< indices of the combinations to judge
};

} // namespace

Result<Simplified> simplify(const scene::Scene& scene, const SimplifyRequest& request, const Watch& watch,
                            const Circumstances& circumstances) {
    return Simplifier(scene, request, watch, circumstances).run();
}

} // namespace tidemark::lab
