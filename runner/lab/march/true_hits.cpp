#include "lab/march/true_hits.hpp"

#include "ir/first_hit.hpp"
#include "lab/on_all_cores.hpp"
#include "lab/spread.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace tidemark::lab {
namespace {

constexpr double k_relative_width = 1e-9;
constexpr uint64_t k_most_evaluations = 20'000;
/// Number of rays from which the time per ray is estimated.
constexpr size_t k_pilot = 64;

constexpr ir::Interval k_miss{-1, -1};

/// Returns the interval of the first hit; k_miss if there is none; nullopt if it is not known.
std::optional<ir::Interval> hit_of(const MarchRays& rays, size_t number, ir::Surface surface) {
    const int width = rays.extent().width;
    auto ray = rays.enter({int(number) % width, int(number) / width}, surface);
    if (!ray || (ray->slice && ray->march.turns.empty()))
        return k_miss;
    if (!ray->slice)
        return std::nullopt;
    ir::MarchSlice& slice = *ray->slice;
    const bool limited = ray->march.far.has_value();
    const double last = slice.end(ray->march);
    if (last < slice.start())
        return limited ? std::optional(k_miss) : std::nullopt;
    const ir::FirstHit found = ir::first_hit(slice, last, k_most_evaluations, k_relative_width);
    if (found.verdict == ir::FirstHit::Verdict::hit)
        return ir::Interval{found.where.low * slice.unit(), found.where.high * slice.unit()};
    const bool none = found.verdict == ir::FirstHit::Verdict::none && limited;
    return none ? std::optional(k_miss) : std::nullopt;
}

using Found = std::vector<std::optional<ir::Interval>>;

/// The first few rays, and the seconds that one takes.
struct Pilot {
    ir::Surface surface;
    Found found{};
    double seconds = 0;

    Pilot(const MarchRays& rays, ir::Surface which) : surface(which) {
        const size_t pixels = rays.extent().pixels();
        const auto start = std::chrono::steady_clock::now();
        while (found.size() < std::min(k_pilot, pixels))
            found.push_back(hit_of(rays, spread(found.size(), pixels), surface));
        const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
        seconds = all.count() / double(found.size());
    }

    size_t hits() const {
        return size_t(
            std::ranges::count_if(found, [](const auto& each) { return each && each->low != k_miss.low; }));
    }
};

/// Searches for zeros, unless fewer than half of the rays that fall below the threshold have one.
Pilot pilot_of(const MarchRays& rays) {
    Pilot zeros(rays, ir::Surface::zero), places(rays, ir::Surface::threshold);
    return 2 * zeros.hits() < places.hits() ? places : zeros;
}

TrueHits truth_of(const Found& found, size_t pixels, ir::Surface surface) {
    TrueHits truth;
    truth.surface = surface;
    truth.looked_at = found.size();
    truth.hits.distance.assign(pixels, std::nan(""));
    truth.hits.evaluations.assign(pixels, 0.0f);
    truth.hits.flags.assign(pixels, 0);
    double squares = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        if (!found[i]) {
            ++truth.unknown;
            continue;
        }
        truth.hits.distance[spread(i, pixels)] = found[i]->low + found[i]->width() / 2;
        squares += found[i]->width() * found[i]->width() / 4;
    }
    truth.half_width = std::sqrt(squares / double(std::max<size_t>(1, truth.looked_at - truth.unknown)));
    return truth;
}

} // namespace

std::optional<TrueHits> true_hits(const DrawnPass& drawn, double seconds, const KeepGoing& keep_going) {
    const MarchRays rays(drawn);
    const size_t pixels = rays.extent().pixels();
    Pilot pilot = pilot_of(rays);
    Found& found = pilot.found;
    const double affordable = seconds * std::max(1u, std::thread::hardware_concurrency()) / pilot.seconds;
    const auto every = size_t(std::ceil(std::max(1.0, double(pixels) / affordable)));
    const size_t first = found.size();
    found.resize(std::max(first, pixels / every));
    const bool complete = on_all_cores(found.size() - first, keep_going, [&](size_t i) {
        found[first + i] = hit_of(rays, spread(first + i, pixels), pilot.surface);
    });
    return complete ? std::optional(truth_of(found, pixels, pilot.surface)) : std::nullopt;
}

} // namespace tidemark::lab
