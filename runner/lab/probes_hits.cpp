// Checks the hits of rays for steps that were too long and for step budgets that run out.

#include "base/error.hpp"
#include "lab/probed_pictures.hpp"
#include "lab/probed_rays.hpp"
#include "lab/probes.hpp"
#include "lab/scene_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tidemark::lab {
namespace {

constexpr double k_multiples[] = {0, 0.5, 2, 4};

/// Returns both ends of the knob's range and multiples of its value inside; only multiples if it has no
/// range. They are sorted by their texts, each once.
std::vector<scene::KnobSetting> ends_and_multiples(const scene::Knob& knob, const Promises& promises) {
    auto range = knob.range;
    if (const auto promised = promises.ranges.find(knob.name); promised != promises.ranges.end()) {
        range.emplace();
        range->low.fill(promised->second.first);
        range->high.fill(promised->second.second);
        if (scene::info(knob.type).whole)
            for (size_t i = 0; i < range->low.size(); ++i) {
                range->low[i] = std::ceil(range->low[i]);
                range->high[i] = std::floor(range->high[i]);
            }
    }
    std::map<std::string, scene::KnobValue> values;
    for (const double factor : k_multiples) {
        scene::KnobValue value = knob.value;
        for (size_t i = 0; i < value.size(); ++i) {
            value[i] *= factor;
            if (range)
                value[i] = std::clamp(value[i], range->low[i], range->high[i]);
            if (scene::info(knob.type).whole)
                value[i] = std::clamp(std::floor(value[i]), -2147483648.0, 2147483647.0);
        }
        values.emplace(scene::to_string(knob, value), value);
    }
    if (range) {
        values.emplace(scene::to_string(knob, range->low), range->low);
        values.emplace(scene::to_string(knob, range->high), range->high);
    }
    std::vector<scene::KnobSetting> settings;
    for (const auto& [text, value] : values)
        settings.push_back(scene::setting_of(knob, value));
    return settings;
}

/// Returns multiples of the numbers that the text defines under names of heights or scales. At most four
/// names, as each value needs a compilation.
std::vector<Setting> multiples_of_definitions(const ProbeBench& bench) {
    std::vector<DefinedNumber> numbers =
        defined_numbers(bench.scene(), {"height", "ampl", "scale", "steep", "chop"});
    numbers.resize(std::min<size_t>(numbers.size(), 4));
    std::vector<Setting> settings;
    for (const DefinedNumber& number : numbers) {
        const auto promised = bench.promises().ranges.find(number.name);
        for (const double factor : k_multiples) {
            double multiple = factor * number.value;
            if (promised != bench.promises().ranges.end())
                multiple = std::clamp(multiple, promised->second.first, promised->second.second);
            settings.push_back({number.name, number.whole ? fmt::format("{:.0f}", std::floor(multiple))
                                                          : fmt::format("{:#.9g}", multiple)});
        }
    }
    return settings;
}

std::vector<FrameState> stiff_states(const ProbeBench& bench) {
    std::vector<FrameState> states;
    for (const scene::Knob& knob : bench.scene().knobs)
        for (const scene::KnobSetting& setting : ends_and_multiples(knob, bench.promises())) {
            states.push_back(typical_view());
            states.back().knobs = {setting};
        }
    for (const Setting& setting : multiples_of_definitions(bench)) {
        states.push_back(typical_view());
        states.back().definitions = {setting};
    }
    return states;
}

} // namespace

namespace {

/// Returns whether a recorded march goes back by itself from a sample below the surface, since it waits for a
/// small absolute distance.
bool goes_back_itself(ProbeBench& bench) {
    const auto& image = bench.image_function();
    return !bench.has_main_hit() && image &&
           std::ranges::any_of(image->loops(), [&](const proof::MarchingLoop& loop) {
               return image->function().instructions[loop.distance].op == proof::Op::absolute;
           });
}

Answer without_fault_below() {
    return {Verdict::not_applicable,
            "the march waits for a small absolute distance, so it goes back from a sample below the surface"};
}

} // namespace

Result<Answer> ask_overstep(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench, true);
    if (!bench.sees_below())
        return without_sign();
    if (goes_back_itself(bench))
        return without_fault_below();
    const double promised =
        most_allowed(bench, bench.promises().most_overstep_percent, "most_overstep_percent");
    FlaggedRays most = TRY(most_flagged(bench, glsl::k_hit_negative));
    Answer answer{
        Verdict::pass,
        fmt::format("{:.3g} % of the rays take a sample below the surface in the worst of four views",
                    most.percent)};
    if (most.percent > promised) {
        answer.verdict = fault(bench);
        answer.sentence += allowed(promised);
        answer.where = most.where;
        answer.picture = std::move(most.map);
    }
    if (!bench.main_hit_problem().empty()) {
        answer.verdict = std::max(answer.verdict, Verdict::warn);
        answer.sentence +=
            "; mainHit does not compile, so the march of mainImage is recorded: " + bench.main_hit_problem();
    }
    return answer;
}

Result<Answer> ask_budget(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    return running_out_answer(bench, TRY(most_running_out(bench, usual_views())), "four views", "budget");
}

Result<Answer> ask_lipschitz_sweep(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    if (!bench.sees_below())
        return without_sign();
    if (goes_back_itself(bench))
        return without_fault_below();
    Answer answer{Verdict::not_applicable, "the scene has no knob, and defines no height or scale", {}, {}};
    const double allowed_percent =
        most_allowed(bench, bench.promises().most_overstep_percent, "most_overstep_percent");
    const double as_is = flagged(TRY(bench.hits(typical_view())), glsl::k_hit_negative);
    double most = -1;
    for (const FrameState& state : stiff_states(bench)) {
        const std::string set = state.knobs.empty() ? to_string(state.definitions) : to_string(state.knobs);
        const auto hits = TRY(bench.hits(state));
        if (const double nothing = unanswered(hits); nothing > 0)
            return Answer{
                .verdict = fault(bench),
                .sentence =
                    fmt::format("{}: {:.3g} % of the distances are NaN, infinite or negative", set, nothing),
                .where = state,
                .effect = fmt::format("with {} rays have no distance: it is NaN, infinite or negative", set)};
        const double overstepping = flagged(hits, glsl::k_hit_negative);
        if (overstepping <= most)
            continue;
        most = overstepping;
        answer = {overstepping <= std::max(allowed_percent, 2 * as_is) ? Verdict::pass
                  : bench.has_main_hit()                               ? Verdict::warn
                                                                       : Verdict::note,
                  fmt::format("at worst, with {}: {:.3g} % of the rays take a sample below the surface, "
                              "{:.3g} % run out of steps",
                              set, overstepping, flagged(hits, glsl::k_hit_exhausted)),
                  {},
                  {}};
        if (answer.verdict != Verdict::pass)
            answer.where = state;
    }
    return answer;
}

// Compares the rays of scenes with known hits in float and in double: as time goes on, near the surface, with
// large noise coordinates, and in waves that intersect themselves.

namespace {

Answer without_doubles(const Error& error) {
    return {Verdict::not_applicable, "cannot be drawn in double: " + to_string(error)};
}

/// Returns whether a viewer would see that rays hit other places in float. Scenes that cannot be drawn in
/// double count as well.
Result<bool> shows_in_picture(ProbeBench& bench, const FrameState& state, bool from_the_start) {
    const auto floats = TRY(bench.picture(state));
    const auto doubles = bench.picture(state, glsl::Precision::promoted);
    return !doubles || breaks_up(floats, *doubles, from_the_start);
}

} // namespace

Result<Answer> ask_rays(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    double good = 0;
    for (const double time : {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const FrameState state = state_at_float(time, typical_view());
        const auto both = float_mismatch(bench, state);
        if (!both)
            return without_doubles(both.error());
        if (both->mismatched_percent <= k_same) {
            good = time;
            continue;
        }
        const bool kept = good >= bench.promises().time_horizon;
        return Answer{
            kept                                                                     ? Verdict::pass
            : good > 0 && bench.promises().stated.contains("time_horizon")           ? Verdict::fail
            : bench.has_main_hit() || TRY(shows_in_picture(bench, state, good == 0)) ? Verdict::warn
                                                                                     : Verdict::note,
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
        answer.sentence += ": the hit threshold is below the rounding error of the field; raise it";
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
    if (count.knob)
        state.knobs = {{count.name, {1, {octaves}}}};
    else
        state.definitions = {{count.name, fmt::format("{:g}", octaves)}};
    return state;
}

Result<Answer> ask_count(ProbeBench& bench, const Count& count) {
    const Extremes extremes = extremes_of(bench, count);
    for (const double octaves : {extremes.least, extremes.most}) {
        const FrameState state = with_octaves(count, octaves);
        const auto hits = bench.hits(state);
        if (!hits)
            return Answer{
                .verdict = extremes.stated ? Verdict::warn : Verdict::note,
                .sentence = fmt::format("{} = {:g}: {}", count.name, octaves, to_string(hits.error())),
                .effect = fmt::format("the scene cannot be drawn with {} = {:g}", count.name, octaves)};
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
        answer.verdict = extremes.stated ? fault(bench) : Verdict::note;
        answer.sentence += ": the coordinates of the finest octave are beyond float precision";
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
    Answer all{Verdict::not_applicable, "no knob or definition sets a number of octaves"};
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
        return Answer{Verdict::not_applicable, "no knob sets the steepness of waves"};
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
        state.knobs = {scene::setting_of(*knob, value)};
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
            inside || steepness < 1 ? fault(bench) : Verdict::note,
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

// Checks whether a scene's mainHit still matches its mainImage: compares its hits with those of the march,
// recorded while mainImage runs.

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
    bench.has_hits(); // tries the mainHit
    if (!bench.has_main_hit())
        return Answer{Verdict::not_applicable, bench.main_hit_problem().empty()
                                                   ? "the scene has no mainHit to compare"
                                                   : "mainHit does not compile: see overstep"};
    if (const std::string& problem = bench.recording_problem(); !problem.empty())
        return Answer{Verdict::not_applicable, "the march is not recorded: " + problem};
    if (bench.fixed_steps())
        return Answer{
            Verdict::not_applicable,
            "the march goes in fixed steps, and mainHit's interpolation between them is not recorded"};
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
        return Answer{Verdict::not_applicable, "no ray reaches the marching loop"};
    answer.sentence =
        fmt::format("mainHit and the march of mainImage differ in {} of {} rays", all.differing, all.entered);
    if (all.largest > 0)
        answer.sentence += fmt::format(", by up to {:.3g} where both hit", all.largest);
    if (100.0 * double(all.differing) > k_same * double(all.entered))
        answer.verdict = Verdict::warn;
    else {
        answer.where.reset();
        answer.picture.reset();
    }
    return answer;
}

} // namespace tidemark::lab
