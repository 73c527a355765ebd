// Checks whether a scene's mainHit still matches its mainImage: compares its hits with those of the march,
// recorded while mainImage runs.
#include "base/try.hpp"
#include "lab/check/probes.hpp"
#include "lab/check/rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

struct Drift {
    size_t rays = 0, entered = 0; ///< entered: rays that enter the march in the recording
    size_t differing = 0;         ///< one hits and the other misses, or both hit different places
    double largest = 0;           ///< difference of the distances if both hit
    std::vector<bool> marks{};
};

/// mainHit may interpolate past the last recorded sample. Distances within a pixel's width, or within one
/// hundredth, are the same hit.
bool is_same(double written, double recorded, Extent extent) {
    if (std::isnan(written) || std::isnan(recorded))
        return std::isnan(written) == std::isnan(recorded);
    if (written < 0 || recorded < 0)
        return (written < 0) == (recorded < 0);
    return std::abs(written - recorded) <= std::max(written, recorded) * std::max(0.01, 1.0 / extent.height);
}

Drift drift_of(const Hits& written, const Hits& recorded, Extent extent) {
    Drift drift{.rays = written.size()};
    for (size_t i = 0; i < written.size(); ++i) {
        const bool entered = recorded.evaluations[i] > 0;
        const double one = written.distance[i], other = recorded.distance[i];
        drift.entered += entered;
        drift.marks.push_back(entered && !is_same(one, other, extent));
        drift.differing += drift.marks.back();
        if (drift.marks.back() && one >= 0 && other >= 0)
            drift.largest = std::max(drift.largest, std::abs(one - other));
    }
    return drift;
}

} // namespace

Result<Answer> ask_drift(ProbeBench& bench) {
    if (!bench.has_main_hit())
        return Answer{Verdict::not_applicable, "the scene has no mainHit to drift"};
    if (!bench.has_hits())
        return without_hits(bench);
    if (const std::string& problem = bench.recording_problem(); !problem.empty())
        return Answer{Verdict::not_applicable, "the march is not recorded: " + problem};
    if (bench.fixed_steps())
        return Answer{
            Verdict::not_applicable,
            "the march goes in fixed steps, and what mainHit interpolates between two is not recorded"};
    Drift all;
    Answer answer;
    for (const FrameState& view : usual_views()) {
        const auto written = TRY(bench.hits(view));
        const Hits recorded = hits_of(TRY(bench.recorded(view, glsl::RecordAnswer::hit)));
        const Drift drift = drift_of(written, recorded, view.extent);
        if (drift.differing > 0 && !answer.where) {
            answer.where = view;
            answer.picture = ray_map(recorded, view.extent, [&](size_t i) { return drift.marks[i]; });
        }
        all.rays += drift.rays;
        all.entered += drift.entered;
        all.differing += drift.differing;
        all.largest = std::max(all.largest, drift.largest);
    }
    if (all.entered == 0)
        return Answer{Verdict::not_applicable, "no ray comes to the loop that marches"};
    answer.sentence =
        fmt::format("mainHit and the march of mainImage part in {} of {} rays", all.differing, all.entered);
    if (all.largest > 0)
        answer.sentence += fmt::format(", by up to {:.3g} where both meet something", all.largest);
    if (100.0 * double(all.differing) > k_same * double(all.entered))
        answer.verdict = Verdict::warn;
    else {
        answer.where.reset();
        answer.picture.reset();
    }
    return answer;
}

} // namespace tidemark::lab
