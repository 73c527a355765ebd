#include "lab/timing.hpp"

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

/// Without the rounds that it did not take part in.
std::vector<double> present(std::vector<double> rounds) {
    std::erase_if(rounds, [](double value) { return std::isnan(value); });
    return rounds;
}

/// From the single runs to the summaries.
void summarise(WorkPrecision& point) {
    for (size_t view = 0; view < point.views.size(); ++view) {
        point.views[view].time = summary_of(present(point.wall[view]));
        point.views[view].cpu = summary_of(present(point.cpu[view]));
    }
    point.all.time = summary_of(present(mean_of_views(point.wall)));
    point.all.cpu = summary_of(present(mean_of_views(point.cpu)));
}

/// Draws points on views and keeps the clocks.
class Timer {
public:
    Timer(const Watch& watch, std::vector<std::optional<Specimen>>& specimens, WorkPrecisionSet& set)
        : watch_(watch), specimens_(specimens), set_(set), seconds_(set.points.size(), 0.0) {}

    /// One round of the points for which `takes_part` holds. False: stopped.
    template <class TakesPart>
    bool round(size_t number, bool keep, TakesPart takes_part) {
        const size_t views = set_.study.views.size();
        if (keep)
            make_room();
        for (const size_t place : shuffled(set_.points.size() * views, k_seed + unsigned(number))) {
            const size_t index = place / views, view = place % views;
            WorkPrecision& point = set_.points[index];
            if (!point.measured() || !takes_part(index))
                continue;
            if (!watch_.keep_going())
                return false;
            const Elapsed cost = specimens_[index]->time(set_.study.views[view]);
            if (keep) {
                point.wall[view].back() = cost.wall;
                point.cpu[view].back() = cost.cpu;
            } else if (number == 0) {
                seconds_[index] += cost.wall * 1e-3;
            }
        }
        watch_.advance();
        return true;
    }

    /// What round 0 cost of one point on all views.
    double seconds(size_t point) const { return seconds_[point]; }

private:
    /// A place for one more round, not a number until it is run.
    void make_room() {
        for (WorkPrecision& point : set_.points)
            for (auto* clock : {&point.wall, &point.cpu}) {
                clock->resize(set_.study.views.size());
                for (std::vector<double>& rounds : *clock)
                    rounds.push_back(std::nan(""));
            }
    }

    const Watch& watch_;
    std::vector<std::optional<Specimen>>& specimens_;
    WorkPrecisionSet& set_;
    std::vector<double> seconds_;
};

} // namespace

bool takes_part(size_t round, size_t affordable, size_t total) {
    return affordable >= total || (round + 1) * affordable / total > round * affordable / total;
}

bool time_points(const Timing& timing, const Watch& watch, std::vector<std::optional<Specimen>>& specimens,
                 WorkPrecisionSet& set) {
    Circumstances& facts = set.circumstances;
    facts.load_before = load_average();
    Timer timer(watch, specimens, set);
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
