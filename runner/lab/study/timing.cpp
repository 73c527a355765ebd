#include "lab/study/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tidemark::lab {
namespace {

constexpr unsigned k_seed = 20261;

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
void summarise(WorkPrecision& point) {
    const auto of = [](const std::vector<double>& rounds) { return summary_of(present(rounds)); };
    for (size_t view = 0; view < point.views.size(); ++view) {
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
            if (keep)
                note(set_.points[index], place % views, cost);
            else
                trial_[place].push_back(cost);
        }
        watch_.advance();
        return true;
    }

    /// Returns the seconds that round 0 took for a point, over all views.
    double seconds(size_t point) const {
        double sum = 0;
        const size_t views = set_.study.views.size();
        for (size_t place = point * views; place < (point + 1) * views; ++place)
            sum += trial_[place].empty() ? 0 : trial_[place].front().elapsed.wall * 1e-3;
        return sum;
    }

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
    return agree()
               ? fmt::format("GPU timer, which says {} of the wall clock around glFinish", ratio)
               : fmt::format("wall clock around glFinish (the driver's GPU timer, which says {} of it, is "
                             "not believed)",
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
    const double share = timing.budget / double(std::max<size_t>(1, set.points.size()));
    const size_t total = timing.warm_up_rounds + timing.rounds;
    std::vector<size_t> affordable;
    for (size_t i = 0; i < set.points.size(); ++i) {
        const double rounds = share / std::max(timer.seconds(i), 1e-6);
        affordable.push_back(size_t(std::clamp(rounds, 1.0, double(total))));
    }
    watch.begin("rounds timed", total - 1);
    for (size_t number = 1; going && number < total; ++number) {
        const bool keep = number >= timing.warm_up_rounds;
        if (number == timing.warm_up_rounds)
            timer.choose_clock();
        going = timer.round(number, keep,
                            [&](size_t point) { return takes_part(number, affordable[point], total); });
        facts.timed_rounds += keep && going;
    }
    facts.warm_up_rounds = timing.warm_up_rounds;
    facts.load_after = load_average();
    for (WorkPrecision& point : set.points)
        if (point.measured() && !point.wall.empty())
            summarise(point);
    return going;
}

} // namespace tidemark::lab
