#include "proof/march_slice.hpp"

#include "proof/loops.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tidemark::proof {
namespace {

/// Limits for the paths through undecided conditions: decisions in one run, and paths in all.
constexpr size_t k_most_decisions = 14;
constexpr int k_few_ways = 32;
constexpr int k_many_ways = 2048;
constexpr uint64_t k_most_steps = 2'000'000;
int most_ways(Care care) {
    return care == Care::thorough ? k_many_ways : k_few_ways;
}
/// Instructions that count as one run: a field of seven octaves has about a thousand.
constexpr uint64_t k_long_run = 20'000;

/// Returns a look-up with slopes: a texture value at a varying place may have any slope.
Textures<Tangent> with_slopes(const Textures<Interval>& textures) {
    return [textures](const Lookup& lookup, std::span<const Tangent> operands) {
        std::vector<Interval> places;
        for (const Tangent& operand : operands)
            places.push_back(operand.value);
        const bool constant = std::ranges::all_of(operands, &Tangent::constant);
        return Tangent{textures ? textures(lookup, places) : everything(),
                       constant ? Interval{} : everything()};
    };
}

template <class Real>
Interval bounds(const Point<Real>& point) {
    return IntervalSystem::number(double(point.real));
}
const Interval& bounds(const Interval& interval) {
    return interval;
}

/// Returns the change of a carried value per unit of the parameter.
template <class System>
Interval factor_of(const Carried& carried, const Evaluator<System>& entered) {
    Interval product = k_one;
    for (const Value factor : carried.factors)
        product = product * bounds(entered.value(factor));
    return product;
}

} // namespace

template <class System>
MarchSlice::MarchSlice(const LoopSlice& slice, const Evaluator<System>& entered,
                       const Textures<Interval>& textures, Surface surface)
    : loop_(&slice.loop), surface_(surface), intervals_(slice, entered, textures),
      tangents_(slice, entered, with_slopes(textures)) {
    intervals_.evaluator().most_steps = tangents_.evaluator().most_steps = k_most_steps;
    for (const Carried& each : loop_->carried) {
        const bool itself = loop_->by_parameter();
        first_.push_back(itself ? Interval{} : bounds(entered.value(each.phi)));
        factor_.push_back(itself ? k_one : factor_of(each, entered));
    }
    if (loop_->by_parameter()) {
        const Interval start = bounds(entered.value(loop_->carried[0].phi));
        start_ = start.partial ? -k_infinity : start.low;
    }
    if (loop_->limited())
        if (const Interval far = bounds(entered.value(loop_->far)); !far.partial && std::isfinite(far.high))
            far_ = far.high;
}
template MarchSlice::MarchSlice(const LoopSlice&, const FloatEvaluator&, const Textures<Interval>&, Surface);
template MarchSlice::MarchSlice(const LoopSlice&, const PointEvaluator<double>&, const Textures<Interval>&,
                                Surface);
template MarchSlice::MarchSlice(const LoopSlice&, const Evaluator<IntervalSystem>&, const Textures<Interval>&,
                                Surface);

double MarchSlice::parameter(const Turn& turn) const {
    size_t longest = 0;
    for (size_t i = 1; i < factor_.size(); ++i)
        if (std::abs(factor_[i].low) > std::abs(factor_[longest].low))
            longest = i;
    return (turn.carried[longest] - first_[longest].low) / factor_[longest].low;
}

double MarchSlice::unit() const {
    if (std::ranges::any_of(loop_->carried, [](const Carried& each) { return each.factors.empty(); }))
        return 1;
    Interval squares;
    for (const Interval& factor : factor_)
        squares = squares + square(factor);
    return std::sqrt(squares.low);
}

template <class System>
auto MarchSlice::run(LoopTurn<System>& turn, const std::vector<typename System::Value>& places,
                     Decisions& decisions) -> std::optional<Compared<typename System::Value>> {
    const Ended ended = turn.run(places, decisions);
    evaluations_ += 1 + turn.evaluator().steps() / k_long_run;
    if (ended == Ended::left || ended == Ended::discarded)
        return std::nullopt;
    if (ended != Ended::stopped)
        return Compared<typename System::Value>{System::unknown(), System::unknown()};
    return Compared<typename System::Value>{turn.distance(), turn.threshold()};
}

double MarchSlice::end(const March& march) const {
    constexpr double k_beyond = 1.5; // a hit of the exact field slightly after the march's is still found
    if (march.far)
        return *march.far;
    auto last = march.turns.rbegin();
    while (last + 1 != march.turns.rend() && !std::isfinite(parameter(*last)))
        ++last;
    return start_ + (march.hit ? k_beyond : 1) * (parameter(*last) - start_);
}

Interval MarchSlice::place(size_t carried, const Interval& parameter) const {
    if (loop_->by_parameter())
        return parameter;
    return first_[carried] + factor_[carried] * parameter;
}

std::vector<Interval> MarchSlice::places(const Interval& parameter) const {
    std::vector<Interval> places;
    for (size_t i = 0; i < loop_->carried.size(); ++i)
        places.push_back(place(i, parameter));
    return places;
}

std::optional<Interval> MarchSlice::distance(const Interval& parameter, Care care) {
    const auto found = distances(parameter, care);
    return found ? std::optional(found->own) : std::nullopt;
}

auto MarchSlice::distances(const Interval& parameter, Care care) -> std::optional<Distances> {
    const std::vector<Interval> at = places(parameter);
    set(care);
    Decisions decisions(k_most_decisions);
    std::optional<Distances> all;
    for (int way = 0; way == 0 || decisions.next(); ++way) {
        const auto one = run(intervals_, at, decisions);
        if (way == most_ways(care) || decisions.exhausted())
            return Distances{everything(false), everything(false)}; // too many paths mean too many jumps
        if (!one)
            continue;
        const Interval above = one->distance - one->threshold;
        const Interval own = surface_ == Surface::zero ? one->distance : above;
        all = all ? Distances{hull(all->own, own), hull(all->above_threshold, above)} : Distances{own, above};
    }
    return all;
}

std::optional<Interval> MarchSlice::advance(const Interval& parameter, Care care) {
    const std::vector<Interval> at = places(parameter);
    set(care);
    Decisions decisions(k_most_decisions);
    std::optional<Interval> all;
    for (int way = 0; way == 0 || decisions.next(); ++way) {
        const Ended ended = intervals_.step(at, decisions);
        evaluations_ += 1 + intervals_.evaluator().steps() / k_long_run;
        if (way == most_ways(care) || decisions.exhausted() || ended == Ended::too_long)
            return everything();
        if (ended == Ended::stopped)
            all = all ? hull(*all, intervals_.advance()) : intervals_.advance();
    }
    return all;
}

std::vector<Tangent> MarchSlice::moving_places(const Interval& parameter) const {
    std::vector<Tangent> places;
    for (size_t i = 0; i < loop_->carried.size(); ++i)
        places.push_back({place(i, parameter), factor_[i]});
    return places;
}

Tangent MarchSlice::own(const Compared<Tangent>& found) const {
    const auto& [distance, threshold] = found;
    if (surface_ == Surface::zero)
        return distance;
    return {distance.value - threshold.value, distance.slope - threshold.slope};
}

std::optional<Tangent> MarchSlice::tangent(const Interval& parameter) {
    Decisions none(0);
    const auto found = run(tangents_, moving_places(parameter), none);
    if (!found || none.exhausted())
        return std::nullopt;
    const Tangent all = own(*found);
    return !all.value.partial && std::isfinite(all.slope.low) ? std::optional(all) : std::nullopt;
}

std::optional<Interval> MarchSlice::slope_beside_jumps(const Interval& parameter) {
    bool& aside = tangents_.evaluator().system().jumps_aside;
    aside = true;
    Decisions decisions(k_most_decisions);
    std::optional<Interval> all;
    for (int way = 0; way == 0 || decisions.next(); ++way) {
        const auto found = run(tangents_, moving_places(parameter), decisions);
        const bool open = way == most_ways(Care::close) || decisions.exhausted();
        const Tangent one = found && !open ? own(*found) : Tangent{};
        if (open || one.value.partial || !std::isfinite(one.slope.low)) {
            all.reset();
            break;
        }
        if (found)
            all = all ? hull(*all, one.slope) : one.slope;
    }
    aside = false;
    return all;
}

bool MarchSlice::excludes_hit(const std::optional<Interval>& distance) const {
    if (!distance)
        return true;
    const bool above = loop_->at_equality ? distance->low > 0 : distance->low >= 0;
    return above && !(distance->partial && loop_->at_nan);
}

bool MarchSlice::is_hit(const std::optional<Interval>& distance) const {
    return distance && !distance->partial && (loop_->at_equality ? distance->high <= 0 : distance->high < 0);
}

FloatField::FloatField(const LoopSlice& slice, const FloatEvaluator& entered)
    : turn_(slice, entered, entered.textures), by_parameter_(slice.loop.by_parameter()) {
    for (const Carried& each : slice.loop.carried) {
        first_.push_back(by_parameter_ ? 0 : entered.value(each.phi).real);
        factor_.push_back(by_parameter_ ? 1 : float(factor_of(each, entered).low));
    }
}

std::optional<float> FloatField::distance(double parameter) {
    std::vector<Point<float>> places;
    for (size_t i = 0; i < first_.size(); ++i)
        places.push_back({first_[i] + factor_[i] * float(parameter), 0});
    Decisions none(0);
    return turn_.run(places, none) == Ended::stopped ? std::optional(turn_.distance().real) : std::nullopt;
}

namespace {

March followed(FloatEvaluator& evaluator, const Function& function, const MarchingLoop& loop, uint32_t most) {
    March march;
    uint32_t iterations = 0;
    const auto carried = [&] {
        std::vector<float> values;
        for (const Carried& each : loop.carried)
            values.push_back(evaluator.value(loop.cut(each)).real);
        return values;
    };
    std::vector<float> before;
    const std::vector<bool> inside = natural_loop(function, loop.header);
    const auto idle_condition = [&](uint32_t block) {
        return evaluator.value(function.blocks[block].condition).bits != 0;
    };
    const auto visit = [&](uint32_t block) {
        if (!inside[block])
            return false;
        if (block == loop.test && (!loop.in_next_turn || !before.empty())) {
            march.turns.push_back({loop.in_next_turn ? before : carried(),
                                   evaluator.value(loop.distance).real,
                                   evaluator.value(loop.threshold).real});
        }
        if (block == loop.latch) {
            before = carried();
            if (++iterations == most)
                return false;
        }
        return !loop.idle || block != loop.idle->block || idle_condition(block) != loop.idle->when;
    };
    if (loop.limited())
        if (const float far = evaluator.value(loop.far).real; std::isfinite(far))
            march.far = far;
    Decisions none(0);
    evaluator.run(none, visit, loop.header, loop.entry);
    if (!march.turns.empty()) {
        const float last = march.turns.back().distance();
        march.hit = loop.at_equality ? last <= 0 : last < 0;
    }
    return march;
}

} // namespace

March follow(FloatEvaluator& evaluator, const Function& function, const MarchingLoop& loop) {
    return followed(evaluator, function, loop, 0);
}

March follow_on(FloatEvaluator& evaluator, const Function& function, const MarchingLoop& loop,
                uint32_t most) {
    for (const MarchingLoop::CounterTest& test : loop.counter_tests)
        evaluator.pin(test.comparison, {0, test.continues});
    March march = followed(evaluator, function, loop, most);
    evaluator.unpin();
    return march;
}

bool is_faithful(const LoopSlice& slice, const FloatEvaluator& entered, const March& march) {
    LoopTurn<PointSystem<float>> own(slice, entered, entered.textures);
    const auto same = [](float a, float b) {
        return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
    };
    return std::ranges::all_of(march.turns, [&](const Turn& turn) {
        std::vector<Point<float>> places;
        for (const float each : turn.carried)
            places.push_back({each, 0});
        Decisions none(0);
        const bool measured = own.run(places, none) == Ended::stopped;
        const float threshold = own.threshold().real;
        return measured && same(own.distance().real, turn.measured) &&
               (slice.loop.threshold_by_turn ? threshold <= turn.threshold : same(threshold, turn.threshold));
    });
}

} // namespace tidemark::proof
