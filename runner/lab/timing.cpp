#include "lab/timing.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>

namespace tidemark::lab {
namespace {

constexpr unsigned k_seed = 20261;

double load_average() {
    double load = 0;
    return ::getloadavg(&load, 1) == 1 ? load : 0;
}

/// One point on one view.
struct Unit {
    size_t point;
    size_t view;
};

std::vector<double> by_round(const std::vector<std::vector<double>>& views) {
    std::vector<double> means;
    for (size_t round = 0; round < views.front().size(); ++round) {
        double sum = 0;
        for (const auto& rounds : views)
            sum += rounds[round];
        means.push_back(sum / double(views.size()));
    }
    return means;
}

/// From the single runs to the summaries. Rounds that were not finished are cut off.
void summarise(WorkPrecision& point, size_t rounds) {
    for (auto* clock : {&point.wall, &point.cpu})
        for (std::vector<double>& runs : *clock)
            runs.resize(rounds);
    for (size_t view = 0; view < point.views.size(); ++view) {
        point.views[view].time = summary_of(point.wall[view]);
        point.views[view].cpu = summary_of(point.cpu[view]);
    }
    point.all.time = summary_of(by_round(point.wall));
    point.all.cpu = summary_of(by_round(point.cpu));
}

} // namespace

Rounds rounds_within(const Timing& timing, double round_seconds) {
    const double affordable = round_seconds > 0 ? timing.budget / round_seconds : 1e9;
    const size_t wanted = timing.warm_up_rounds + timing.rounds;
    if (affordable >= double(wanted))
        return {timing.warm_up_rounds, timing.rounds};
    const auto total = std::max<size_t>(2, size_t(affordable));
    const size_t warm_up = std::min(timing.warm_up_rounds, std::max<size_t>(1, total / 4));
    return {warm_up, std::min(timing.rounds, total - warm_up)};
}

bool time_points(const Timing& timing, const Watch& watch, std::vector<std::optional<Specimen>>& specimens,
                 WorkPrecisionSet& set) {
    std::vector<Unit> units;
    const size_t views = set.study.views.size();
    for (size_t i = 0; i < set.points.size(); ++i) {
        if (!set.points[i].measured())
            continue;
        set.points[i].wall.resize(views);
        set.points[i].cpu.resize(views);
        for (size_t view = 0; view < views; ++view)
            units.push_back({i, view});
    }
    const auto round = [&](size_t number, bool keep) {
        for (const size_t place : shuffled(units.size(), k_seed + unsigned(number))) {
            const Unit unit = units[place];
            if (!watch.keep_going())
                return false;
            const Specimen::Cost cost = specimens[unit.point]->time(set.study.views[unit.view]);
            if (keep) {
                set.points[unit.point].wall[unit.view].push_back(cost.wall);
                set.points[unit.point].cpu[unit.view].push_back(cost.cpu);
            }
        }
        watch.advance();
        return true;
    };
    Circumstances& facts = set.circumstances;
    facts.load_before = load_average();
    watch.begin("trial round", 1);
    const auto start = std::chrono::steady_clock::now();
    bool going = round(0, false);
    const std::chrono::duration<double> trial = std::chrono::steady_clock::now() - start;
    const Rounds rounds = rounds_within(timing, trial.count());
    watch.begin("rounds timed", rounds.warm_up + rounds.timed - 1);
    for (facts.warm_up_rounds = 1; going && facts.warm_up_rounds < rounds.warm_up; ++facts.warm_up_rounds)
        going = round(facts.warm_up_rounds, false);
    while (going && facts.timed_rounds < rounds.timed) {
        going = round(rounds.warm_up + facts.timed_rounds, true);
        facts.timed_rounds += going;
    }
    facts.load_after = load_average();
    for (WorkPrecision& point : set.points)
        if (point.measured())
            summarise(point, facts.timed_rounds);
    return going;
}

} // namespace tidemark::lab
