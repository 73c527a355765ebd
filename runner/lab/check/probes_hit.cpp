// Checks the hits of rays for steps that were too long and for step budgets that run out.
#include "base/try.hpp"
#include "lab/check/probes.hpp"
#include "lab/check/rays.hpp"
#include "lab/defined_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tidemark::lab {
namespace {

/// Compares the largest percentage of flagged rays over the usual views with the promised limit.
Result<Answer> most_flagged(ProbeBench& bench, glsl::HitFlag flag, double promised, const char* what) {
    if (!bench.has_hits())
        return without_hits(bench);
    FlaggedRays most = TRY(most_flagged(bench, flag));
    Answer answer{most.percent > promised ? fault(bench) : Verdict::pass,
                  fmt::format("{:.3g} % of the rays {} in the worst of four views", most.percent, what),
                  {},
                  {}};
    if (answer.verdict != Verdict::pass) {
        answer.sentence += fmt::format("; allowed: {:g} % (change it in NAME.check.json)", promised);
        answer.where = most.where;
        answer.picture = std::move(most.map);
    }
    return answer;
}

constexpr double k_multiples[] = {0, 0.5, 2, 4};

/// Returns both ends of the knob's range and multiples of its value inside; only multiples if it has no
/// range.
std::vector<Setting> ends_and_multiples(const scene::Knob& knob, const Promises& promises) {
    auto range = knob.range;
    if (const auto promised = promises.ranges.find(knob.name); promised != promises.ranges.end()) {
        range.emplace();
        range->low.fill(promised->second.first);
        range->high.fill(promised->second.second);
    }
    std::set<std::string> values;
    for (const double factor : k_multiples) {
        scene::KnobValue value = knob.value;
        for (size_t i = 0; i < value.size(); ++i) {
            value[i] *= factor;
            if (range)
                value[i] = std::clamp(value[i], range->low[i], range->high[i]);
            if (scene::info(knob.type).whole)
                value[i] = std::floor(value[i]);
        }
        values.insert(scene::to_string(knob, value));
    }
    if (range) {
        values.insert(scene::to_string(knob, range->low));
        values.insert(scene::to_string(knob, range->high));
    }
    std::vector<Setting> settings;
    for (const std::string& value : values)
        settings.push_back({knob.name, value});
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
        for (const Setting& setting : ends_and_multiples(knob, bench.promises())) {
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

Result<Answer> ask_overstep(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench, true);
    if (!bench.sees_below())
        return without_sign();
    return most_flagged(bench, glsl::k_hit_negative, bench.promises().most_overstep_percent,
                        "take a sample below the surface");
}

Result<Answer> ask_budget(ProbeBench& bench) {
    return most_flagged(bench, glsl::k_hit_exhausted, bench.promises().most_exhausted_percent,
                        "run out of steps");
}

Result<Answer> ask_lipschitz_sweep(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    if (!bench.sees_below())
        return without_sign();
    Answer answer{Verdict::not_applicable, "the scene has no knob, and defines no height or scale", {}, {}};
    double most = -1;
    for (const FrameState& state : stiff_states(bench)) {
        const std::string set = to_string(merged(state.knobs.empty() ? state.definitions : state.knobs));
        const auto hits = TRY(bench.hits(state));
        if (const double nothing = unanswered(hits); nothing > 0)
            return Answer{
                fault(bench),
                fmt::format("{}: {:.3g} % of the distances are NaN, infinite or negative", set, nothing),
                state};
        const double overstepping = flagged(hits, glsl::k_hit_negative);
        if (overstepping <= most)
            continue;
        most = overstepping;
        answer = {overstepping > bench.promises().most_overstep_percent ? Verdict::warn : Verdict::pass,
                  fmt::format("at worst, with {}: {:.3g} % of the rays take a sample below the surface, "
                              "{:.3g} % run out of steps",
                              set, overstepping, flagged(hits, glsl::k_hit_exhausted)),
                  {},
                  {}};
        if (answer.verdict == Verdict::warn)
            answer.where = state;
    }
    return answer;
}

} // namespace tidemark::lab
