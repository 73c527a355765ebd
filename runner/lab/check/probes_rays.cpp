// Compares the rays of scenes with known hits in float and in double: as time goes on, near the surface, with
// large noise coordinates, and in waves that intersect themselves.
#include "base/try.hpp"
#include "lab/check/probes.hpp"
#include "lab/check/rays.hpp"
#include "lab/defined_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

Answer without_doubles(const Error& error) {
    return {Verdict::not_applicable, "cannot be drawn in double: " + to_string(error)};
}

} // namespace

Result<Answer> ask_rays(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    double good = 0;
    for (const double time : {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const FrameState state =
            // A typical moment, which binary32 cannot represent.
            render::at_time(time + 1.0 / 3, typical_view());
        const auto both = float_mismatch(bench, state);
        if (!both)
            return without_doubles(both.error());
        if (both->mismatched_percent <= k_same) {
            good = time;
            continue;
        }
        const bool kept = good >= bench.promises().time_horizon;
        return Answer{
            kept        ? Verdict::pass
            : good == 0 ? Verdict::warn
                        : fault(bench),
            fmt::format(
                "{}; at {:g} s {:.3g} % of the rays hit something else in float, by more than a pixel",
                good == 0 ? std::string("float and double never agree")
                          : fmt::format("float and double agree up to {:g} s", good),
                time, both->mismatched_percent),
            state, both->map};
    }
    return Answer{Verdict::pass, "float and double agree up to 1e6 s, to a pixel's width"};
}

/// Checks for a hit distance below the rounding error of the field: in float the solver never reaches it, in
/// double it does.
Result<Answer> ask_epsilon(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    Answer answer;
    double most = -1;
    for (const FrameState& view : usual_views()) {
        const auto both = float_mismatch(bench, view);
        if (!both)
            return without_doubles(both.error());
        const double out = flagged(both->in_float, glsl::k_hit_exhausted);
        const double out_anyway = flagged(both->in_double, glsl::k_hit_exhausted);
        if (out - out_anyway <= most)
            continue;
        most = out - out_anyway;
        answer.sentence =
            fmt::format("{:.3g} % of the rays run out of steps in float, {:.3g} % in double; samples "
                        "a ray: {:.3g} and {:.3g}",
                        out, out_anyway, mean_evaluations(both->in_float), mean_evaluations(both->in_double));
        answer.where = view;
        answer.picture = ray_map(both->in_float, view.extent, [&](size_t i) {
            return (both->in_float.flags[i] & glsl::k_hit_exhausted) != 0;
        });
    }
    if (most > std::max(bench.promises().most_exhausted_percent, k_same)) {
        answer.verdict = fault(bench);
        answer.sentence +=
            ": the solver waits for a value below the rounding error of its field; raise its hit distance";
    } else {
        answer.where.reset();
        answer.picture.reset();
    }
    return answer;
}

namespace {

/// A number of octaves, from a definition or a knob.
struct Count {
    std::string name;
    double value;
    bool knob;
};

std::vector<Count> counts_of_octaves(const scene::Scene& scene) {
    std::vector<Count> counts;
    for (const DefinedNumber& number : defined_numbers(scene, {"octave"}))
        if (number.whole)
            counts.push_back({number.name, number.value, false});
    for (const scene::Knob& knob : scene.knobs)
        if (speaks_of(knob.name, {"octave"}))
            counts.push_back({knob.name, knob.value[0], true});
    return counts;
}

/// Range of a number of octaves: as the scene states it, or from 1 to 1.5 times the current number.
struct Extremes {
    double least = 1;
    double most = 0;
    bool stated = true; ///< the scene states the range
};
Extremes extremes_of(const ProbeBench& bench, const Count& count) {
    const auto promised = bench.promises().ranges.find(count.name);
    if (promised != bench.promises().ranges.end())
        return {promised->second.first, promised->second.second};
    const auto knob = std::ranges::find(bench.scene().knobs, count.name, &scene::Knob::name);
    if (count.knob && knob->range)
        return {knob->range->low[0], knob->range->high[0]};
    return {1, std::ceil(1.5 * count.value), false};
}

FrameState with_octaves(const Count& count, double octaves) {
    FrameState state = typical_view();
    (count.knob ? state.knobs : state.definitions) =
        std::vector{scene::Setting{count.name, fmt::format("{:g}", octaves)}};
    return state;
}

Result<Answer> ask_count(ProbeBench& bench, const Count& count) {
    const Extremes extremes = extremes_of(bench, count);
    for (const double octaves : {extremes.least, extremes.most}) {
        const FrameState state = with_octaves(count, octaves);
        const auto hits = bench.hits(state);
        if (!hits)
            return Answer{Verdict::warn,
                          fmt::format("{} = {:g}: {}", count.name, octaves, to_string(hits.error()))};
        if (const double lost = unanswered(*hits); lost > 0)
            return Answer{fault(bench),
                          fmt::format("{} = {:g}: {:.3g} % of the distances are NaN, infinite or negative",
                                      count.name, octaves, lost),
                          state};
    }
    const FrameState state = with_octaves(count, extremes.most);
    const auto both = float_mismatch(bench, state);
    if (!both)
        return without_doubles(both.error());
    Answer answer{
        Verdict::pass,
        fmt::format("with {} = {:g} {:.3g} % of the rays hit something else in float than in double",
                    count.name, extremes.most, both->mismatched_percent)};
    if (both->mismatched_percent > k_same) {
        answer.verdict = extremes.stated ? fault(bench) : Verdict::warn;
        answer.sentence += ": the coordinates of the finest octave are beyond what floats hold";
        answer.where = state;
        answer.picture = both->map;
    }
    return answer;
}

} // namespace

Result<Answer> ask_octaves(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    const std::vector<Count> counts = counts_of_octaves(bench.scene());
    Answer all{Verdict::not_applicable, "no definition and no knob is a number of octaves"};
    for (const Count& count : counts) {
        auto answer = ask_count(bench, count);
        if (!answer || answer->verdict != Verdict::pass)
            return answer;
        answer->sentence = (all.verdict == Verdict::pass ? all.sentence + "; " : "") + answer->sentence;
        all = *std::move(answer);
    }
    return all;
}

/// Checks waves for self-intersection. A trochoidal wave train's steepness is its height times its
/// wavenumber; where trains add up to 1 or more, the surface is not a function of the horizontal position.
Result<Answer> ask_self_intersection(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    const auto knob = std::ranges::find_if(
        bench.scene().knobs, [](const scene::Knob& each) { return speaks_of(each.name, {"steepness"}); });
    double sum = 0;
    if (knob != bench.scene().knobs.end())
        for (const double part : knob->value)
            sum += std::abs(part);
    // A steepness that moves no ray on its own may belong to something else, such as foam.
    if (sum == 0)
        return Answer{Verdict::not_applicable, "no knob is a steepness of waves"};
    const auto as_is = TRY(bench.hits(typical_view()));
    bool moves = false;
    double calm = 0;
    for (const double steepness : {0.75, 0.99, 1.0, 1.5}) {
        FrameState state = typical_view();
        scene::KnobValue value = knob->value;
        bool inside = true;
        for (size_t i = 0; i < value.size(); ++i) {
            value[i] *= steepness / sum;
            inside &= !knob->range || value[i] <= knob->range->high[i];
        }
        state.knobs = {{knob->name, scene::to_string(*knob, value)}};
        const auto both = float_mismatch(bench, state);
        if (!both)
            return without_doubles(both.error());
        moves |= both->in_float.distance != as_is.distance;
        const double lost = unanswered(both->in_float);
        if (lost == 0 && both->mismatched_percent <= k_same) {
            calm = steepness;
            continue;
        }
        return Answer{
            inside || steepness < 1 ? fault(bench) : Verdict::warn,
            fmt::format(
                "waves whose steepness adds up to {:g}{} intersect themselves: {:.3g} % of the rays hit "
                "something else in float than in double, {:.3g} % of the distances are NaN, infinite or "
                "negative",
                steepness, inside ? "" : " (beyond the knob's range)", both->mismatched_percent, lost),
            state, both->map};
    }
    if (!moves)
        return Answer{Verdict::not_applicable, fmt::format("{} changes no ray", knob->name)};
    return Answer{Verdict::pass, fmt::format("no wave intersects itself where {} adds up to {:g} or less",
                                             knob->name, calm)};
}

} // namespace tidemark::lab
