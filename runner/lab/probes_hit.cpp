// What rays met, of scenes with mainHit: steps that were too long, and too many of them.
#include "glsl/hit.hpp"
#include "lab/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace tidemark::lab {
namespace {

constexpr Extent k_extent{96, 54};

/// Straight, to the horizon, down and grazing, for scenes that turn with the mouse.
std::vector<Situation> usual_views() {
    std::vector<Situation> views{{.extent = k_extent, .time = 10}};
    for (const glm::dvec2 at : {glm::dvec2(0.5, 0.5), glm::dvec2(0.75, 0.4), glm::dvec2(0.3, 0.47)})
        views.push_back({.extent = k_extent,
                         .time = 10,
                         .mouse = glm::ivec2(at * glm::dvec2(k_extent.width, k_extent.height))});
    return views;
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

Answer without_hits() {
    return {Verdict::not_applicable, "the scene has no mainHit"};
}

/// The largest share of flagged rays in the usual views, against what is promised.
Result<Answer> most_flagged(ProbeBench& bench, glsl::HitFlag flag, double promised, const char* what) {
    if (!bench.has_hits())
        return without_hits();
    double most = -1;
    Situation where;
    for (const Situation& view : usual_views()) {
        const auto hits = bench.hits(view);
        if (!hits)
            return fail(hits.error());
        if (const double share = flagged(*hits, flag); share > most) {
            most = share;
            where = view;
        }
    }
    Answer answer{most > promised ? Verdict::fail : Verdict::pass,
                  fmt::format("{:.3g} % of the rays {} in the worst of four views", most, what),
                  {},
                  {}};
    if (answer.verdict == Verdict::fail) {
        answer.sentence += fmt::format("; promised are at most {:g} %", promised);
        answer.where = where;
    }
    return answer;
}

} // namespace

Result<Answer> ask_witnesses(ProbeBench& bench) {
    return most_flagged(bench, glsl::k_hit_negative, bench.promises().most_witness_percent,
                        "take a sample below the surface");
}

Result<Answer> ask_budget(ProbeBench& bench) {
    return most_flagged(bench, glsl::k_hit_exhausted, bench.promises().most_exhausted_percent,
                        "run out of steps");
}

Result<Answer> ask_stiffness(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits();
    Answer answer{Verdict::not_applicable, "the scene has no knob with a range", {}, {}};
    double most = -1;
    for (const scene::Knob& knob : bench.scene().knobs) {
        if (!knob.range)
            continue;
        for (const scene::KnobValue& end : {knob.range->low, knob.range->high}) {
            Situation situation = usual_views()[2];
            situation.settings = {{knob.name, scene::to_string(knob, end)}};
            const auto hits = bench.hits(situation);
            if (!hits)
                return fail(hits.error());
            const double witnesses = flagged(*hits, glsl::k_hit_negative);
            if (const double nothing = unanswered(*hits); nothing > 0)
                return Answer{Verdict::fail,
                              fmt::format("{} = {}: {:.3g} % of the distances are no number", knob.name,
                                          scene::to_string(knob, end), nothing),
                              situation,
                              {}};
            if (witnesses <= most)
                continue;
            most = witnesses;
            answer = {
                witnesses > bench.promises().most_witness_percent ? Verdict::warn : Verdict::pass,
                fmt::format("at worst, with {} = {}: {:.3g} % of the rays take a sample below the surface, "
                            "{:.3g} % run out of steps",
                            knob.name, scene::to_string(knob, end), witnesses,
                            flagged(*hits, glsl::k_hit_exhausted)),
                {},
                {}};
            if (answer.verdict == Verdict::warn)
                answer.where = situation;
        }
    }
    return answer;
}

} // namespace tidemark::lab
