#include "lab/check/rays.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tidemark::lab {
namespace {

bool parts(double here, double there, Extent extent) {
    if (std::isnan(here) || std::isnan(there))
        return std::isnan(here) != std::isnan(there);
    if (here < 0 || there < 0)
        return (here < 0) != (there < 0);
    return std::abs(here - there) > std::max(here, there) / extent.height;
}

} // namespace

std::vector<FrameState> usual_views() {
    const FrameState untouched = state_at(10, k_ray_extent);
    std::vector<FrameState> views{untouched};
    for (const glm::dvec2 at : {glm::dvec2(0.5, 0.5), glm::dvec2(0.75, 0.4), glm::dvec2(0.3, 0.47)})
        views.push_back(with_mouse(
            render::Mouse::clicked(at * glm::dvec2(k_ray_extent.width, k_ray_extent.height), false),
            untouched));
    return views;
}

FrameState typical_view() {
    return usual_views()[2];
}

double percent(const Hits& hits, const std::function<bool(size_t)>& counts) {
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i)
        count += counts(i);
    return 100.0 * double(count) / double(std::max<size_t>(hits.size(), 1));
}

double flagged(const Hits& hits, glsl::HitFlag flag) {
    return percent(hits, [&](size_t i) { return (hits.flags[i] & flag) != 0; });
}

double unanswered(const Hits& hits) {
    return percent(hits, [&](size_t i) { return std::isnan(hits.distance[i]); });
}

double mean_evaluations(const Hits& hits) {
    return std::accumulate(hits.evaluations.begin(), hits.evaluations.end(), 0.0) /
           double(std::max<size_t>(hits.size(), 1));
}

image::Image ray_map(const Hits& hits, Extent extent, const std::function<bool(size_t)>& marks) {
    double nearest = 1e30;
    for (const double distance : hits.distance)
        if (distance > 0)
            nearest = std::min(nearest, distance);
    image::Image map(extent, 3, image::SampleType::f32);
    for (size_t i = 0; i < hits.size(); ++i) {
        const double distance = hits.distance[i];
        const bool marked = std::isnan(distance) || marks(i);
        const float grey = marked || !(distance > 0) ? 0.0f : float(std::sqrt(nearest / distance));
        const float shown[] = {marked ? 1.0f : grey, grey, marked ? 1.0f : grey};
        std::ranges::copy(shown, map.f32().begin() + std::ptrdiff_t(3 * i));
    }
    return map;
}

Answer without_hits(const ProbeBench& bench, bool warns) {
    if (!bench.has_main_hit())
        return {Verdict::not_applicable, "no mainHit, and the march is not recorded: " + bench.hit_problem()};
    return warns ? Answer{Verdict::warn, "mainHit does not compile: " + bench.hit_problem()}
                 : Answer{Verdict::not_applicable, "mainHit does not compile: see overstep"};
}

Answer without_sign() {
    return {Verdict::not_applicable,
            "the march goes in fixed steps or waits for a sample below the surface: none proves anything"};
}

Verdict fault(const ProbeBench& bench) {
    return bench.has_main_hit() ? Verdict::fail : Verdict::warn;
}

Result<FloatMismatch> float_mismatch(ProbeBench& bench, const FrameState& state) {
    auto in_float = TRY(bench.hits(state));
    auto in_double = TRY(bench.hits(state, glsl::Precision::promoted));
    FloatMismatch both{std::move(in_float), std::move(in_double), {}, 0, {}};
    for (size_t i = 0; i < both.in_float.size(); ++i)
        both.mismatched.push_back(parts(both.in_float.distance[i], both.in_double.distance[i], state.extent));
    const auto marks = [&](size_t i) { return both.mismatched[i]; };
    both.mismatched_percent = percent(both.in_float, marks);
    both.map = ray_map(both.in_float, state.extent, marks);
    return both;
}

Result<FlaggedRays> most_flagged(ProbeBench& bench, glsl::HitFlag flag) {
    FlaggedRays most{.percent = -1};
    for (const FrameState& view : usual_views()) {
        const auto hits = TRY(bench.hits(view));
        if (const double share = flagged(hits, flag); share > most.percent)
            most = {share, view,
                    ray_map(hits, view.extent, [&](size_t i) { return (hits.flags[i] & flag) != 0; })};
    }
    return most;
}

} // namespace tidemark::lab
