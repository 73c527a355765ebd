#include "lab/study/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
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
    const std::string most =
        hits.no_truth > 0 ? fmt::format(" (no more than {} % at 95 %)", figure(hits.most_wrong_tenth)) : "";
    return fmt::format("{} % wrong{}, ", figure(hits.wrong_tenth), most);
}

std::string quality_of(const WorkPrecisionSet& set, const WorkPrecision& point) {
    return (point.all.hits ? wrong_of(*point.all.hits) : "") +
           (point.hollow ? fmt::format("hollow: at least {:.1f} dB", least_psnr(set, point))
                         : fmt::format("{:.1f} dB", point.all.picture.samples.psnr));
}

std::string cheapest_sentence(const WorkPrecisionSet& set) {
    if (!set.picture_standard.uncertainty)
        return fmt::format("no verdict on {}: the truth's own error is unknown", promise_of(set));
    const WorkPrecision* best = cheapest_good(set);
    if (!best)
        return fmt::format("no setting of this study is sure to have {}", promise_of(set));
    return fmt::format("cheapest setting with {}: {} ({}; {})", promise_of(set), best->point.label,
                       cost_of(*best), quality_of(set, *best));
}

std::string equal_error_sentence(const WorkPrecisionSet& set) {
    const WorkPrecision& defaults = set.points.front();
    if (defaults.measured() && defaults.hollow)
        return fmt::format("no verdict at equal error: {} are too close to the truth's own error to rank "
                           "(hollow)",
                           set.words.defaults);
    const WorkPrecision* best = cheapest_as_exact(set);
    if (!best || !defaults.timed())
        return {};
    const auto gain = speedup(defaults, *best);
    if (best != &defaults && !gain)
        return fmt::format("no verdict at equal error: too few rounds of {} and the defaults fit the budget",
                           best->point.label);
    if (best == &defaults)
        return fmt::format("no tested setting is cheaper than {} without being less exact",
                           set.words.defaults);
    if (!gain->certain())
        return fmt::format(
            "at equal error nothing is faster than {} beyond noise (the nearest: {}, {:.2f} x [{:.2f}, "
            "{:.2f}])",
            set.words.defaults, best->point.label, gain->ratio, gain->confidence.low, gain->confidence.high);
    return fmt::format("at equal error {:.2f} x [{:.2f}, {:.2f}] {} than {}: {}", gain->ratio,
                       gain->confidence.low, gain->confidence.high, gain->ratio > 1 ? "faster" : "slower",
                       set.words.defaults, best->point.label);
}

/// Returns whether no point differs visibly from the unchanged scene, so there is nothing to choose from.
bool all_idle(const WorkPrecisionSet& set) {
    return !set.idle.empty() &&
           std::all_of(set.points.begin() + 1, set.points.end(),
                       [](const WorkPrecision& point) { return point.idle || !point.measured(); });
}

void add_verdicts(const WorkPrecisionSet& set, std::vector<std::string>& found) {
    for (const IdleKnob& knob : set.idle)
        found.push_back(fmt::format("{} changes nothing here: {} shows the same to the bit at all its values",
                                    knob.name,
                                    knob.series == knob.name ? "the scene" : "'" + knob.series + "'"));
    if (!set.picture_standard.none.empty())
        found.push_back("there is no truth about the pictures: " + set.picture_standard.none +
                        "; --reference names one");
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
    const double error = error_of(set, set.points.front().all);
    return cheapest(
        set, [&](const WorkPrecision& point) { return !point.hollow && error_of(set, point.all) <= error; });
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
    const auto hollow = std::ranges::count_if(set.points, &WorkPrecision::hollow);
    if (hollow > 0 && standard_of(set).none.empty())
        found.push_back(
            fmt::format("{} too close to the truth's own error to rank (hollow)",
                        hollow == 1 ? std::string("1 point is") : fmt::format("{} points are", hollow)));
    for (const auto& [what, blind] :
         {std::pair{"pictures", set.picture_standard.blind}, {"hits", set.hit_standard.blind}})
        if (blind > 0)
            found.push_back(
                fmt::format("the truth about the {} is NaN or infinite in {}, whose error is "
                            "unknown",
                            what, blind == 1 ? std::string("1 pixel") : fmt::format("{} pixels", blind)));
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
        "held fixed, in the truth too, so that no figure tells what it costs: {}{}", to_string(first),
        shown < set.held.size() ? fmt::format(" and {} more (study.json)", set.held.size() - shown) : "");
}

} // namespace tidemark::lab
