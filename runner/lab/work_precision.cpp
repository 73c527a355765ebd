#include "lab/work_precision.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <compare>

namespace tidemark::lab {
namespace {

constexpr double k_solid = 10; ///< an error is reliable from this many uncertainties of the reference on

/// Returns whether `a` is at least as good as `b` in both error and time, and better in one.
bool dominates(const WorkPrecisionSet& set, const WorkPrecision& a, const WorkPrecision& b) {
    const double time_a = a.all.time().median, time_b = b.all.time().median;
    return no_more_wrong(set, a.all, b.all) && time_a <= time_b &&
           (time_a < time_b || !no_more_wrong(set, b.all, a.all));
}

/// Returns by which order two shares of wrong rays differ for certain.
std::partial_ordering compare_wrong(const HitErrors& a, const HitErrors& b) {
    if (a.least_wrong_tenth > b.most_wrong_tenth)
        return std::partial_ordering::greater;
    return a.most_wrong_tenth < b.least_wrong_tenth ? std::partial_ordering::less
                                                    : std::partial_ordering::equivalent;
}

} // namespace

bool no_more_wrong(const WorkPrecisionSet& set, const Outcome& a, const Outcome& b) {
    if (set.has_hits() && a.hits && b.hits)
        if (const auto wrong = compare_wrong(*a.hits, *b.hits); wrong != std::partial_ordering::equivalent)
            return wrong == std::partial_ordering::less;
    return error_of(set, a) <= error_of(set, b);
}

double error_of(const WorkPrecisionSet& set, const Outcome& outcome) {
    return set.ranked_by_hits() && outcome.hits ? outcome.hits->rms : outcome.picture.samples.rmse;
}

std::string error_name(const WorkPrecisionSet& set) {
    return set.ranked_by_hits() ? set.words.distance_error : "RMSE of the picture";
}

const Standard& standard_of(const WorkPrecisionSet& set) {
    return set.ranked_by_hits() ? set.hit_standard : set.picture_standard;
}

std::vector<std::string> set_names(const WorkPrecisionSet& set) {
    std::vector<std::string> names;
    for (const WorkPrecision& point : set.points)
        for (const Setting& setting : point.point.settings)
            if (std::ranges::find(names, setting.name) == names.end())
                names.push_back(setting.name);
    return names;
}

std::string value_at(const WorkPrecisionSet& set, const Point& point, const std::string& name) {
    for (const std::vector<Setting>& settings : {merged(point.settings), set.scene_values})
        if (const auto found = std::ranges::find(settings, name, &Setting::name); found != settings.end())
            return found->value;
    return {};
}

std::string series_name(const WorkPrecisionSet& set, const Point& point) {
    return point.series < set.study.series.size() ? set.study.series[point.series].name
                                                  : std::string(k_defaults);
}

std::vector<double> mean_of_views(const std::vector<std::vector<double>>& clock) {
    std::vector<double> means(clock.empty() ? 0 : clock.front().size(), 0.0);
    for (const std::vector<double>& view : clock)
        for (size_t i = 0; i < means.size(); ++i)
            means[i] += view[i] / double(clock.size());
    return means;
}

void judge(WorkPrecisionSet& set) {
    const auto& uncertainty = standard_of(set).uncertainty;
    for (WorkPrecision& point : set.points) {
        const double error = error_of(set, point.all);
        point.hollow = point.measured() && (!uncertainty || !(error >= k_solid * *uncertainty));
        point.on_front = point.timed() && !point.idle && !std::isnan(error) &&
                         std::ranges::none_of(set.points, [&](const WorkPrecision& other) {
                             return other.timed() && !other.idle && dominates(set, other, point);
                         });
    }
}

namespace {

constexpr unsigned k_seed = 20261;
/// Share of the budget that the second warm-up may take of points whose first drawing was too slow for more.
constexpr double k_second_round = 0.5;

double load_average() {
    double load = 0;
    return ::getloadavg(&load, 1) == 1 ? load : 0;
}

/// Removes the rounds in which the point did not take part.
std::vector<double> present(std::vector<double> rounds) {
    std::erase_if(rounds, [](double value) { return std::isnan(value); });
    return rounds;
}

/// Computes the summaries from the single runs.
void summarise(WorkPrecision& point, bool by_cpu) {
    const auto of = [](const std::vector<double>& rounds) { return summary_of(present(rounds)); };
    point.all.by_cpu = by_cpu;
    for (size_t view = 0; view < point.views.size(); ++view) {
        point.views[view].by_cpu = by_cpu;
        point.views[view].wall = of(point.wall[view]);
        point.views[view].cpu = of(point.cpu[view]);
        if (!point.gpu.empty())
            point.views[view].gpu = of(point.gpu[view]);
    }
    point.all.wall = of(mean_of_views(point.wall));
    point.all.cpu = of(mean_of_views(point.cpu));
    if (!point.gpu.empty())
        point.all.gpu = of(mean_of_views(point.gpu));
}

/// Runs points in views and keeps their times.
class Timer {
public:
    Timer(const Watch& watch, const Run& run, WorkPrecisionSet& set)
        : watch_(watch), run_(run), set_(set), trial_(set.points.size() * set.study.views.size()) {}

    /// Runs one round of the points for which `takes_part` holds. Returns false if it was cancelled.
    template <class TakesPart>
    bool round(size_t number, bool keep, TakesPart takes_part) {
        const size_t views = set_.study.views.size();
        if (keep)
            make_room();
        for (const size_t place : shuffled(set_.points.size() * views, k_seed + unsigned(number))) {
            const size_t index = place / views;
            if (!set_.points[index].measured() || !takes_part(index))
                continue;
            if (!watch_.keep_going())
                return false;
            const Cost cost = run_(index, place % views, !keep || gpu_);
            spent_ += cost.elapsed.wall * 1e-3;
            if (keep)
                note(set_.points[index], place % views, cost);
            else
                trial_[place].push_back(cost);
        }
        watch_.advance();
        return true;
    }

    /// Returns the seconds that a point took in the warm-up, over all views: the shortest run of each,
    /// because the first one may hold the driver's compiler.
    double seconds(size_t point) const {
        double sum = 0;
        const size_t views = set_.study.views.size();
        for (size_t place = point * views; place < (point + 1) * views; ++place)
            if (!trial_[place].empty())
                sum += 1e-3 * std::ranges::min(trial_[place], {}, wall_of).elapsed.wall;
        return sum;
    }

    /// Returns how many of `total` rounds each point can take part in.
    std::vector<size_t> affordable(double budget, size_t total) const {
        const double share = budget / double(std::max<size_t>(1, set_.points.size()));
        std::vector<size_t> rounds;
        for (size_t i = 0; i < set_.points.size(); ++i)
            rounds.push_back(size_t(std::clamp(share / std::max(seconds(i), 1e-6), 1.0, double(total))));
        return rounds;
    }

    /// Returns the seconds of all runs.
    double spent() const { return spent_; }

    /// Chooses the clock, after the warm-up.
    void choose_clock() {
        ClockComparison comparison;
        for (const std::vector<Cost>& costs : trial_) {
            std::vector<double> wall, gpu;
            for (const Cost& cost : costs)
                if (cost.gpu) {
                    wall.push_back(cost.elapsed.wall);
                    gpu.push_back(*cost.gpu);
                }
            if (!wall.empty())
                comparison.add(median(gpu), median(wall));
        }
        gpu_ = comparison.agree();
        set_.circumstances.clock = comparison.clock();
    }

private:
    static double wall_of(const Cost& cost) { return cost.elapsed.wall; }

    static void note(WorkPrecision& point, size_t view, const Cost& cost) {
        point.wall[view].back() = cost.elapsed.wall;
        point.cpu[view].back() = cost.elapsed.cpu;
        if (!point.gpu.empty() && cost.gpu)
            point.gpu[view].back() = *cost.gpu;
    }

    /// Adds an entry for one more round, NaN until it is run.
    void make_room() {
        for (WorkPrecision& point : set_.points)
            for (auto* clock : {&point.wall, &point.cpu, &point.gpu}) {
                if (clock == &point.gpu && !gpu_)
                    continue;
                clock->resize(set_.study.views.size());
                for (std::vector<double>& rounds : *clock)
                    rounds.push_back(std::nan(""));
            }
    }

    const Watch& watch_;
    const Run& run_;
    WorkPrecisionSet& set_;
    std::vector<std::vector<Cost>> trial_; ///< of the warm-up, by point and view
    double spent_ = 0;
    bool gpu_ = false;
};

} // namespace

void ClockComparison::add(double gpu, double wall) {
    least = std::min(least, gpu / wall);
    most = std::max(most, gpu / wall);
    ++compared;
}

bool ClockComparison::agree() const {
    return compared > 0 && least >= 0.9 && most <= 1.1;
}

std::string ClockComparison::clock() const {
    if (compared == 0)
        return "wall clock around glFinish";
    const std::string ratio = fmt::format("{:.2f} to {:.2f}", least, most);
    return agree() ? fmt::format("GPU timer, which shows {} of the wall clock around glFinish", ratio)
                   : fmt::format(
                         "wall clock around glFinish (the driver's GPU timer shows {} of it and is not used)",
                         ratio);
}

bool takes_part(size_t round, size_t affordable, size_t total) {
    return affordable >= total || (round + 1) * affordable / total > round * affordable / total;
}

bool time_points(const Timing& timing, const Watch& watch, const Run& run, WorkPrecisionSet& set) {
    if (!timing.wanted(set))
        return true;
    Circumstances& facts = set.circumstances;
    facts.load_before = load_average();
    Timer timer(watch, run, set);
    watch.begin("trial round", 1);
    bool going = timer.round(0, false, [](size_t) { return true; });
    const size_t total = timing.warm_up_rounds + timing.rounds;
    const double second_ends = timer.spent() + k_second_round * timing.budget;
    std::vector<size_t> affordable = timer.affordable(timing.budget, total);
    watch.begin("rounds timed", total - 1);
    for (size_t number = 1; going && number < total; ++number) {
        const bool keep = number >= timing.warm_up_rounds, second = number == 1 && !keep;
        if (number == timing.warm_up_rounds)
            timer.choose_clock();
        going = timer.round(number, keep, [&](size_t point) {
            return (second && timer.spent() < second_ends) || takes_part(number, affordable[point], total);
        });
        if (second)
            affordable = timer.affordable(timing.budget, total);
        facts.timed_rounds += keep && going;
    }
    facts.warm_up_rounds = timing.warm_up_rounds;
    facts.load_after = load_average();
    for (WorkPrecision& point : set.points)
        if (point.measured() && !point.wall.empty())
            summarise(point, timing.by_cpu);
    return going;
}

namespace {

/// Returns a lower bound of a picture's PSNR that allows for the truth's own error; NaN: unknown.
double least_psnr(const WorkPrecisionSet& set, const WorkPrecision& point) {
    const auto& truth = set.picture_standard.uncertainty;
    return truth ? -20 * std::log10(point.all.picture.samples.rmse + *truth) : std::nan("");
}

/// Returns whether the point keeps the promise even if the truth's own error counts against it.
bool keeps(const WorkPrecisionSet& set, const WorkPrecision& point) {
    const Promise& promise = set.study.promise;
    const auto& hits = point.all.hits;
    // A wrong hit can be distinguished from a right one if the truth's error is at most a tenth of the
    // distance that separates them.
    const bool distinct =
        set.hit_standard.uncertainty && *set.hit_standard.uncertainty <= 0.1 * k_wrong_distance;
    if (set.ranked_by_hits() && !(distinct && hits && hits->most_wrong_tenth <= promise.most_wrong_percent))
        return false;
    return !set.has_pictures() || least_psnr(set, point) >= promise.least_psnr;
}

template <class Wanted>
const WorkPrecision* cheapest(const WorkPrecisionSet& set, Wanted wanted) {
    const WorkPrecision* best = nullptr;
    for (const WorkPrecision& point : set.points)
        if (point.timed() && !point.idle && wanted(point) &&
            (!best || point.all.time().median < best->all.time().median))
            best = &point;
    return best;
}

std::string promise_of(const WorkPrecisionSet& set) {
    const Promise& promise = set.study.promise;
    return (set.ranked_by_hits() ? fmt::format("wrong <= {:g} % and ", promise.most_wrong_percent) : "") +
           fmt::format("PSNR >= {:g} dB", promise.least_psnr);
}

std::string wrong_of(const HitErrors& hits) {
    const std::string most = hits.no_truth > 0 ? fmt::format(" (at most {} %, with 95 % confidence)",
                                                             figure(hits.most_wrong_tenth))
                                               : "";
    return fmt::format("{} % wrong{}, ", figure(hits.wrong_tenth), most);
}

std::string quality_of(const WorkPrecisionSet& set, const WorkPrecision& point) {
    return (point.all.hits ? wrong_of(*point.all.hits) : "") +
           (point.hollow ? fmt::format("hollow: at least {:.1f} dB", least_psnr(set, point))
                         : fmt::format("{:.1f} dB", point.all.picture.samples.psnr));
}

/// Says which point comes nearest to a promise that none keeps: by the fewest wrong rays, then by PSNR.
std::string nearest_sentence(const WorkPrecisionSet& set) {
    const double truth = -20 * std::log10(*set.picture_standard.uncertainty);
    if (truth < set.study.promise.least_psnr)
        return fmt::format("the reference itself is known to {:.1f} dB only", truth);
    const auto& best = *std::ranges::min_element(set.points, {}, [&](const WorkPrecision& point) {
        return std::pair(set.ranked_by_hits() && point.all.hits ? point.all.hits->wrong_tenth : 0.0,
                         -least_psnr(set, point));
    });
    return fmt::format("the nearest is {} ({}; {})", best.point.label, cost_of(best), quality_of(set, best));
}

std::string cheapest_sentence(const WorkPrecisionSet& set) {
    if (!set.picture_standard.uncertainty)
        return fmt::format("no verdict on {}: the reference's own error is unknown", promise_of(set));
    const WorkPrecision* best = cheapest_good(set);
    if (!best)
        return fmt::format("no setting of this study certainly has {}: {}", promise_of(set),
                           nearest_sentence(set));
    return fmt::format("cheapest setting with {}: {} ({}; {})", promise_of(set), best->point.label,
                       cost_of(*best), quality_of(set, *best));
}

/// Returns the errors of two points that are not in error_of, for example ", wrong rays 0.1 % and 0 %, PSNR
/// 50.1 dB and 50.3 dB"; empty if there are none.
std::string error_beside(const WorkPrecisionSet& set, const WorkPrecision& from, const WorkPrecision& to) {
    std::string text;
    if (from.all.hits && to.all.hits)
        text += fmt::format("; wrong rays {} % instead of {} %", figure(to.all.hits->wrong_tenth),
                            figure(from.all.hits->wrong_tenth));
    const auto psnr = [](const WorkPrecision& point) { return point.all.picture.samples.psnr; };
    if (set.ranked_by_hits() && set.has_pictures() && std::isfinite(psnr(from)) && std::isfinite(psnr(to)))
        text += fmt::format("; PSNR {:.1f} dB instead of {:.1f} dB", psnr(to), psnr(from));
    return text;
}

std::string equal_error_sentence(const WorkPrecisionSet& set) {
    const WorkPrecision& defaults = set.points.front();
    if (defaults.measured() && defaults.hollow)
        return fmt::format(
            "no verdict at equal error: {} are too close to the reference's own error to rank (hollow)",
            set.words.defaults);
    const WorkPrecision* best = cheapest_as_exact(set);
    if (!best || !defaults.timed())
        return {};
    const std::string beside = error_beside(set, defaults, *best);
    const auto gain = speedup(defaults, *best);
    if (best != &defaults && !gain)
        return fmt::format("no verdict at equal error: too few rounds of {} and the defaults fit the budget",
                           best->point.label);
    if (best == &defaults)
        return fmt::format("no tested setting is cheaper than {} without being less exact",
                           set.words.defaults);
    if (!gain->certain())
        return fmt::format("at equal error no setting is measurably faster than {} (the nearest: {}, {:.2f} "
                           "x [{:.2f}, {:.2f}]{})",
                           set.words.defaults, best->point.label, gain->ratio, gain->confidence.low,
                           gain->confidence.high, beside);
    return fmt::format("at equal error {:.2f} x [{:.2f}, {:.2f}] {} than {}: {}{}", gain->ratio,
                       gain->confidence.low, gain->confidence.high, gain->ratio > 1 ? "faster" : "slower",
                       set.words.defaults, best->point.label, beside);
}

/// Returns whether no point differs visibly from the unchanged scene, so there is nothing to choose from.
bool all_idle(const WorkPrecisionSet& set) {
    return !set.idle.empty() &&
           std::all_of(set.points.begin() + 1, set.points.end(),
                       [](const WorkPrecision& point) { return point.idle || !point.measured(); });
}

void add_verdicts(const WorkPrecisionSet& set, std::vector<std::string>& found) {
    for (const IdleKnob& knob : set.idle)
        found.push_back(
            fmt::format("{} changes nothing here: {} shows the same picture, bit for bit, at all its values",
                        knob.name, knob.series == knob.name ? "the scene" : "'" + knob.series + "'"));
    if (!set.picture_standard.none.empty())
        found.push_back("no reference for the pictures: " + set.picture_standard.none +
                        "; give one with --reference");
    if (all_idle(set))
        return;
    if (set.has_pictures() && set.picture_standard.none.empty()) // a promise is about the visible picture
        found.push_back(cheapest_sentence(set));
    if (!standard_of(set).none.empty())
        return;
    if (std::string sentence = equal_error_sentence(set); !sentence.empty())
        found.push_back(std::move(sentence));
}

} // namespace

std::string cost_of(const WorkPrecision& point) {
    const TimeSummary& time = point.all.time();
    if (std::isnan(time.confidence.low))
        return fmt::format("{} ms, too few rounds for an interval", figure(time.median));
    return fmt::format("{} ms [{}, {}]", figure(time.median), figure(time.confidence.low),
                       figure(time.confidence.high));
}

std::string figure(double value) {
    return fmt::format("{:.3g}", value);
}

std::optional<Speedup> speedup(const WorkPrecision& slow, const WorkPrecision& fast) {
    if (!slow.timed() || !fast.timed())
        return std::nullopt;
    const std::vector<double> a = mean_of_views(slow.rounds()), b = mean_of_views(fast.rounds());
    std::vector<double> ratios;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (!std::isnan(a[i] / b[i]))
            ratios.push_back(a[i] / b[i]);
    if (ratios.size() < k_fewest_runs)
        return std::nullopt;
    return Speedup{median(ratios), bootstrap_median(ratios)};
}

const WorkPrecision* cheapest_good(const WorkPrecisionSet& set) {
    return cheapest(set, [&](const WorkPrecision& point) { return keeps(set, point); });
}

const WorkPrecision* cheapest_as_exact(const WorkPrecisionSet& set) {
    return cheapest(set, [&](const WorkPrecision& point) {
        return !point.hollow && !point.own && no_more_wrong(set, point.all, set.points.front().all);
    });
}

std::vector<std::string> sentences(const WorkPrecisionSet& set) {
    std::vector<std::string> found;
    add_verdicts(set, found);
    const auto drifted = std::ranges::count_if(
        set.points, [](const WorkPrecision& point) { return point.measured() && point.all.time().drifted; });
    if (drifted > 0)
        found.push_back(
            fmt::format("times of {} of {} points drifted while they were measured: the machine was busy",
                        drifted, set.points.size()));
    std::vector<std::string> failed;
    std::string why;
    for (const WorkPrecision& point : set.points)
        if (!point.failure.empty() && (why.empty() || point.failure == why)) {
            failed.push_back(point.point.label);
            why = point.failure;
        }
    if (!failed.empty())
        found.push_back(fmt::format("not measured: {}: {}", fmt::join(failed, "; "), why));
    const auto hollow = std::ranges::count_if(set.points, &WorkPrecision::hollow);
    if (hollow > 0 && standard_of(set).none.empty())
        found.push_back(
            fmt::format("{} too close to the reference's own error to rank (hollow)",
                        hollow == 1 ? std::string("1 point is") : fmt::format("{} points are", hollow)));
    for (const auto& [what, blind] :
         {std::pair{"pictures", set.picture_standard.blind}, {"hits", set.hit_standard.blind}})
        if (blind > 0)
            found.push_back(
                fmt::format("the reference for the {} is NaN or infinite in {}, whose error is unknown", what,
                            blind == 1 ? std::string("1 pixel") : fmt::format("{} pixels", blind)));
    if (!set.circumstances.complete)
        found.emplace_back("incomplete: the study was interrupted");
    return found;
}

std::string held_sentence(const WorkPrecisionSet& set) {
    constexpr size_t k_shown = 8;
    if (set.held.empty())
        return {};
    const size_t shown = std::min(k_shown, set.held.size());
    const std::vector<Setting> first(set.held.begin(), set.held.begin() + long(shown));
    return fmt::format(
        "held fixed, also in the reference, so its error is not measured: {}{}", to_string(first),
        shown < set.held.size() ? fmt::format(" and {} more (study.json)", set.held.size() - shown) : "");
}

} // namespace tidemark::lab
