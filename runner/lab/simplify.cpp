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

namespace tidemark::lab {
namespace {

constexpr size_t k_fewest_trials = 3, k_most_trials = 25;
constexpr double k_enough_milliseconds = 120; ///< for the timing rounds
/// A cut is considered if a frame takes at most this share of its former time.
constexpr double k_pays = 0.985;
/// A trial is not timed again if one round takes more than this share of the former time by both clocks.
constexpr double k_hopeless = 1.1;
/// Limit of the other views, and their last moment in seconds: later a float's rounding shows in many scenes.
constexpr size_t k_most_others = 160;
constexpr double k_latest_moment = 1000;
/// A picture is divided into this many parts; the RMSE of each may be this many times the allowed error.
constexpr int k_part_columns = 16, k_part_rows = 9;
constexpr double k_most_in_a_part = 3;

/// Small differences that the measure rounds to zero count as more than zero.
double error_of(Measure measure, const Outcome& outcome) {
    if (outcome.picture.samples.equal())
        return 0;
    return std::max(error_by(measure, outcome), std::numeric_limits<double>::min());
}

/// Returns the CPU time if the CPU draws, else the wall time.
double clocked(const Elapsed& elapsed, bool by_cpu) {
    return by_cpu ? elapsed.cpu : elapsed.wall;
}

double displayed(const image::Image& picture, int x, int y, int channel) {
    const size_t i =
        (size_t(y) * size_t(picture.extent.width) + size_t(x)) * size_t(picture.channels) + size_t(channel);
    return std::clamp(double(picture.f32()[i]), 0.0, 1.0);
}

/// Returns how far `value` lies outside of what the picture shows at the pixel and its eight neighbours.
double gap_around(double value, const image::Image& picture, int x, int y, int channel) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (int j = std::max(0, y - 1); j <= std::min(y + 1, picture.extent.height - 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(x + 1, picture.extent.width - 1); ++i) {
            const double near = displayed(picture, i, j, channel);
            least = std::min(least, near);
            most = std::max(most, near);
        }
    return std::max({0.0, least - value, value - most});
}

/// Returns the RMSE of a part as displayed. An edge that moves by one pixel does not count: it is in both
/// pictures.
double rmse_of_part(const image::Image& own, const image::Image& cut, int part) {
    const auto [width, height] = own.extent;
    const int column = part % k_part_columns, row = part / k_part_columns;
    double squares = 0;
    size_t samples = 0;
    for (int y = height * row / k_part_rows; y < height * (row + 1) / k_part_rows; ++y)
        for (int x = width * column / k_part_columns; x < width * (column + 1) / k_part_columns; ++x)
            for (int k = 0; k < own.channels; ++k) {
                ++samples;
                const double before = displayed(own, x, y, k), after = displayed(cut, x, y, k);
                if (before == after)
                    continue;
                const double gap =
                    std::max(gap_around(before, cut, x, y, k), gap_around(after, own, x, y, k));
                squares += gap * gap;
            }
    return std::sqrt(squares / double(std::max<size_t>(1, samples)));
}

} // namespace

bool keeps_parts(const Goal& goal, const image::Image& own, const image::Image& cut) {
    for (int part = 0; part < k_part_columns * k_part_rows; ++part)
        if (rmse_of_part(own, cut, part) > k_most_in_a_part * *goal.most_error)
            return false;
    return true;
}

std::vector<View> other_views(const scene::Scene& scene, const std::vector<View>& views, size_t most) {
    const auto reads = [&](std::string_view name) {
        return std::ranges::any_of(scene.passes, [&](const scene::Pass& pass) {
            return (scene.common.text() + pass.text.text()).find(name) != std::string::npos;
        });
    };
    double last = k_latest_moment;
    if (render::may_have_feedback(scene))
        last = std::ranges::max(views, {}, [](const View& view) {
                   return view.state.seconds();
               }).state.seconds();
    const Promises promises;
    const SearchSpace space(scene, promises, {true, reads("iMouse")});
    std::vector<View> others;
    for (const SearchPoint& point : space.survey()) {
        if (others.size() >= most)
            break;
        if (point.time > last || point.knobs != space.plain().knobs)
            continue;
        View view{.name = fmt::format("t={:g}", point.time), .state = render::at_time(point.time)};
        view.mouse = point.mouse.value_or(glm::dvec2(0));
        others.push_back(std::move(view));
    }
    return others;
}

Result<CutBench> CutBench::create(const scene::Scene& scene, Extent extent, std::vector<View> views,
                                  double seconds) {
    auto own = TRY(Specimen::create(scene, {}, extent));
    CutBench bench(scene, extent, std::move(views), std::move(own));
    bench.truth_ = TRY(truth_of(bench.own_.pictures(bench.views_)));
    const Stopwatch clock;
    for (const View& view : other_views(scene, bench.views_, k_most_others)) {
        if (clock.elapsed().wall * 1e-3 > seconds)
            break;
        if (auto truth = truth_of(bench.own_.pictures({view}))) {
            bench.other_views_.push_back(view);
            bench.other_truths_.push_back(*std::move(truth));
        }
    }
    return bench;
}

/// Returns the error in the worst view, or nothing if it exceeds the goal.
std::optional<double> CutBench::error_in(Specimen& specimen, std::span<const View> views, const Truth& truth,
                                         const Goal& goal) const {
    Sight sight;
    const bool all_at_once = render::may_have_feedback(*scene_); // each picture starts at frame 0
    if (all_at_once)
        sight.pictures = as_shown(specimen.pictures({views.begin(), views.end()}));
    double worst = 0;
    for (size_t view = 0; view < views.size(); ++view) {
        if (!all_at_once)
            sight.pictures.push_back(as_shown({specimen.picture(views[view])}).front());
        if (truth.pictures[view].bytes == sight.pictures[view].bytes)
            continue;
        if (!keeps_parts(goal, truth.pictures[view], sight.pictures[view])) // cheaper than the measure
            return std::nullopt;
        const double error = error_of(goal.measure, outcome_of(sight, truth, view));
        if (!(error <= *goal.most_error))
            return std::nullopt;
        worst = std::max(worst, error);
    }
    return worst;
}

std::optional<CutTrial> CutBench::try_cuts(std::span<const glsl::Cure> cuts, Specimen& other,
                                           const Goal& goal) {
    const auto scene = changed(*scene_, cuts);
    auto specimen = scene ? Specimen::create(*scene, {}, extent_) : fail(ErrorCode::load, "");
    if (!specimen)
        return std::nullopt;
    CutTrial trial{*std::move(specimen)};
    const auto error = error_in(trial.specimen, views_, truth_, goal);
    if (!error)
        return std::nullopt;
    trial.error = *error;
    trial.time = relative_time(trial.specimen, other);
    if (trial.time > k_pays)
        return trial;
    for (size_t i = 0; i < other_views_.size(); ++i) {
        const auto elsewhere =
            error_in(trial.specimen, std::span(&other_views_[i], 1), other_truths_[i], goal);
        if (!elsewhere)
            return std::nullopt;
        trial.error = std::max(trial.error, *elsewhere);
    }
    return trial;
}

double CutBench::milliseconds() {
    std::vector<double> rounds;
    for (size_t round = 0; round < k_fewest_trials; ++round) {
        double sum = 0;
        for (const View& view : views_)
            sum += own_.time(view, false).elapsed.wall;
        rounds.push_back(sum / double(views_.size()));
    }
    return median(rounds);
}

double CutBench::seconds_of_trial() {
    const auto drawn = double(views_.size() * (1 + 2 * k_fewest_trials));
    return milliseconds() * 1e-3 * drawn;
}

/// Returns the median ratio of the times, over rounds that draw both alternately.
double CutBench::relative_time(Specimen& one, Specimen& other) const {
    std::vector<Elapsed> ones, others;
    const Stopwatch clock;
    for (size_t round = 0; round < k_most_trials; ++round) {
        if (round >= k_fewest_trials && clock.elapsed().wall > k_enough_milliseconds)
            break;
        Elapsed sums[2]{};
        for (const View& view : views_)
            for (Specimen* const each : {&one, &other}) {
                const Elapsed elapsed = each->time(view, false).elapsed;
                sums[each == &other].wall += elapsed.wall;
                sums[each == &other].cpu += elapsed.cpu;
            }
        ones.push_back(sums[0]);
        others.push_back(sums[1]);
        if (sums[0].wall > k_hopeless * sums[1].wall && sums[0].cpu > k_hopeless * sums[1].cpu)
            break;
    }
    double wall = 0, cpu = 0;
    for (const Elapsed& elapsed : others) {
        wall += elapsed.wall;
        cpu += elapsed.cpu;
    }
    const bool by_cpu = cpu > 0.5 * wall;
    std::vector<double> ratios;
    for (size_t i = 0; i < ones.size(); ++i)
        ratios.push_back(clocked(ones[i], by_cpu) / clocked(others[i], by_cpu));
    return median(ratios);
}

namespace {

/// Longer side of the search pictures; for cuts that depend on the size, of finer ones.
constexpr int k_small = 128, k_fine = 512;
/// The finer pictures are used if one trial takes at most this share of the time budget.
constexpr double k_fine_trial = 0.1;
/// Shares of the time budget: `k_looking`, `k_alone` and `k_together` end the search for places and the
/// trials of cuts alone and together; `k_timing` is for the verdict.
constexpr double k_looking = 0.15, k_alone = 0.45, k_together = 0.7, k_timing = 0.25,
                 k_others = 0.03; ///< `k_others` is for drawing the other views once
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
        CutPlaces places = TRY(find_cuts(scene_, request_.views, small, [&] { return goes_on(k_looking); }));
        std::erase_if(places.cuts,
                      [&](const glsl::Cut& cut) { return !request_.can_be_written(cut.change); });
        auto bench = TRY(CutBench::create(scene_, small, request_.views, k_others * request_.seconds));
        auto fine = fine_bench(bench, places.cuts);
        CutBench& finer = fine ? *fine : bench;
        try_alone(bench, finer, places.cuts);
        others_ = bench.other_view_count();
        combine(std::ranges::any_of(good_, &ChosenCut::hangs_on_size) ? finer : bench);
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

    std::optional<CutTrial> tried(CutBench& bench, std::span<const glsl::Cure> cuts, Specimen& other) {
        const double before = seconds();
        auto trial = bench.try_cuts(cuts, other, searched_);
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

    void try_alone(CutBench& bench, CutBench& finer, const std::vector<glsl::Cut>& cuts) {
        watch_.begin("cuts tried", cuts.size());
        for (const glsl::Cut& cut : cuts) {
            // Time to combine and to judge is needed only if something was found.
            if (!goes_on(good_.empty() ? k_together : k_alone) || !goes_on(k_together, longest_trial_))
                break;
            watch_.advance();
            if (is_decided(cut))
                continue;
            ++tried_;
            CutBench& own = cut.hangs_on_size ? finer : bench;
            const auto trial = tried(own, std::span(&cut.change, 1), own.own());
            refused_ += !trial;
            if (!cut.family.empty())
                remember(cut, trial.has_value());
            if (trial && trial->time <= k_pays)
                good_.push_back({cut.change, trial->error, trial->time, cut.hangs_on_size});
        }
        known_ = cuts.size();
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
        if (good_.empty())
            return;
        way_.push_back({good_.front()}); // tried alone already
        double best = good_.front().time;
        for (const ChosenCut& cut : std::span(good_).subspan(1)) {
            watch_.advance();
            if (!goes_on(k_together))
                break;
            std::vector<ChosenCut> next = way_.back();
            const bool gone = std::ranges::any_of(next, [&](const ChosenCut& other) {
                return !is_inside(other.change, cut.change) && is_inside(cut.change, other.change);
            });
            if (gone)
                continue;
            std::erase_if(next, [&](const ChosenCut& other) { return is_inside(other.change, cut.change); });
            next.push_back(cut);
            const auto trial = tried(bench, changes_of(next), bench.own());
            if (!trial || trial->time > k_pays * best)
                continue;
            best = trial->time;
            way_.push_back(std::move(next));
        }
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
        const double points = k_timing * request_.seconds / (double(k_fewest_rounds) * seconds_a_round);
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
            if (auto scene = changed(scene_, changes_of(way_[step])))
                scenes.emplace_back(fmt::format("step {}: {} cut{}", step + 1, way_[step].size(),
                                                way_[step].size() == 1 ? "" : "s"),
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
            found.chosen = way_[steps_[i - 1]];
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
    std::vector<ChosenCut> good_{};             ///< cuts that pay alone
    std::vector<std::vector<ChosenCut>> way_{}; ///< combinations; each keeps the error
    std::vector<size_t> steps_{};               ///< indices of the combinations to judge
};

} // namespace

Result<Simplified> simplify(const scene::Scene& scene, const SimplifyRequest& request, const Watch& watch,
                            const Circumstances& circumstances) {
    return Simplifier(scene, request, watch, circumstances).run();
}

} // namespace tidemark::lab
