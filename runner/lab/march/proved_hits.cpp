#include "lab/march/proved_hits.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

using Outcome = ProvedRay::Outcome;
using Verdict = ir::FirstHit::Verdict;

/// A march stops within its threshold, and a step of one hundredth is invisible.
constexpr double k_same_end = 0.01;
/// Mipmap levels differ by more than the usual width of a hit; this is still narrower than is visible.
constexpr double k_width_at_any_level = 1e-3;
/// Each evaluation covers all levels; most decided rays need about fifty.
constexpr uint64_t k_most_at_any_level = 500;
/// Below the threshold by more than rounding.
constexpr float k_surely_below = -1e-5f;

/// Returns whether a sample of the march was below the threshold where that is excluded. A march that goes
/// backwards may sample places before its start. For a threshold that changes with the iterations zero is
/// used instead, because the first threshold is not below it.
bool contradicts(const ir::MarchSlice& slice, const ir::March& march, const ir::FirstHit& found,
                 bool threshold_by_turn) {
    const double free_to = found.verdict == Verdict::none ? found.where.high : found.where.low;
    return std::ranges::any_of(march.turns, [&](const ir::Turn& turn) {
        const double at = slice.parameter(turn);
        return (threshold_by_turn ? turn.measured : turn.distance()) < k_surely_below &&
               at >= slice.start() && at < free_to - 1e-6 * std::max(1.0, std::abs(free_to));
    });
}

/// Returns how far the march has passed along the ray. A march that looks for a change of sign ends below the
/// surface and steps back after the loop, so the sample before that counts. Single steps may have been taken
/// back.
double passed_by(const ir::MarchSlice& slice, const ir::March& march) {
    const double last = slice.parameter(march.turns.back());
    if (!march.hit || march.turns.back().threshold != 0)
        return last;
    double before = slice.start();
    for (const ir::Turn& turn : march.turns)
        if (const double at = slice.parameter(turn); at < last)
            before = std::max(before, at);
    return before;
}

/// Returns whether the interval is as narrow as the tolerance by which a march is judged.
bool is_narrow(const ir::FirstHit& found) {
    return found.verdict == Verdict::none ||
           (found.verdict == Verdict::hit &&
            found.where.width() <= k_same_end * std::max(1.0, std::abs(found.where.high)));
}

Outcome outcome_of(const ir::MarchSlice& slice, const ir::March& march, const ir::FirstHit& found) {
    if (found.verdict == Verdict::undecided)
        return Outcome::undecided;
    if (found.verdict == Verdict::none)
        return Outcome::agrees;
    if (!march.hit)
        return Outcome::misses;
    const double ended = passed_by(slice, march);
    const double tolerance = k_same_end * std::max(1.0, std::abs(ended));
    return ended > found.where.high + tolerance ? Outcome::steps_over : Outcome::agrees;
}

} // namespace

std::optional<ProvedRay> prove_ray(const PassFunction& function, const ir::FloatEvaluator& pixel,
                                   const ir::TextureSet& textures, glm::ivec2 at, uint64_t most_evaluations) {
    ir::FloatEvaluator evaluator = pixel;
    bool unknown = false, chooses_level = false;
    evaluator.textures = [&](const ir::Lookup& lookup, std::span<const ir::Point<float>> operands) {
        const auto texels = textures.find(lookup.sampler);
        unknown = unknown || texels == textures.end();
        chooses_level = chooses_level || (!unknown && texels->second->chooses_level(lookup));
        return ir::look_up(textures, lookup, operands);
    };
    const auto loop_index = ir::enter_first(evaluator, function.loops());
    if (!loop_index)
        return std::nullopt;
    ProvedRay ray{at, *loop_index};
    const ir::LoopSlice& loop_slice = function.slices()[*loop_index];
    const ir::FloatEvaluator entered = evaluator;
    unknown = chooses_level = false; // from here on only reads of the march count
    const ir::March march = ir::follow(evaluator, function.function(), loop_slice.loop);
    ray.turns = march.turns.size();
    if (unknown) {
        ray.outcome = Outcome::unknown_texture;
        return ray;
    }
    if (march.turns.empty()) { // its range is empty
        ray.outcome = Outcome::agrees;
        return ray;
    }
    if (!ir::is_faithful(loop_slice, entered, march)) {
        ray.outcome = Outcome::unfaithful;
        return ray;
    }
    ir::MarchSlice slice(loop_slice, entered, ir::textures_in<ir::Interval>(textures));
    const double end = slice.end(march);
    if (end < slice.start()) {
        ray.reason = ir::FirstHit::Reason::not_finite;
        return ray;
    }
    ir::FirstHit found;
    if (chooses_level) {
        ir::MarchSlice at_any(loop_slice, entered, ir::textures_at_any_level(textures));
        found = ir::first_hit(at_any, end, k_most_at_any_level, k_width_at_any_level);
    }
    ray.at_base_level = chooses_level && !is_narrow(found);
    if (!chooses_level || ray.at_base_level)
        found = ir::first_hit(slice, end, most_evaluations);
    ray.outcome = outcome_of(slice, march, found);
    ray.reason = found.reason;
    ray.evaluations = found.evaluations;
    ray.contradicted = contradicts(slice, march, found, loop_slice.loop.threshold_by_turn);
    return ray;
}

void RayCounts::add(const ProvedRay& ray) {
    ++rays;
    contradicted += ray.contradicted;
    at_base_level += ray.at_base_level;
    if (ray.evaluations > 0)
        evaluations.push_back(double(ray.evaluations));
    if (!wrong_loop && (ray.outcome == Outcome::steps_over || ray.outcome == Outcome::misses))
        wrong_loop = ray.loop;
    switch (ray.outcome) {
    case Outcome::agrees: ++agree; break;
    case Outcome::steps_over: ++step_over; break;
    case Outcome::misses: ++miss; break;
    case Outcome::undecided:
        ++undecided;
        ++reasons[size_t(ray.reason)];
        break;
    case Outcome::unknown_texture: ++unknown_texture; break;
    case Outcome::unfaithful: ++unfaithful; break;
    }
}

ir::FirstHit::Reason RayCounts::commonest() const {
    return ir::FirstHit::Reason(std::ranges::max_element(reasons) - reasons.begin());
}

} // namespace tidemark::lab
