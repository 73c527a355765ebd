#include "ir/march_slice.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tidemark::ir {
namespace {

/// Ways through undecided conditions: so many decisions after one another, so many ways in all.
constexpr size_t k_most_decisions = 14;
constexpr int k_few_ways = 32;
constexpr int k_many_ways = 2048;
constexpr uint64_t k_most_steps = 2'000'000;
/// Instructions that count as one run: a field of seven octaves has a thousand.
constexpr uint64_t k_long_run = 20'000;

/// From the loop's entry to the test that looks at the distance of the first turn, which is at those
/// `places`: stopped where it has come to that. The next turn, if it is that one's, goes on as the text does.
template <class System>
Ended run_to_test(Evaluator<System>& evaluator, const MarchingLoop& loop,
                  const std::vector<typename System::Value>& places, Decisions& decisions) {
    for (size_t i = 0; i < loop.carried.size(); ++i)
        evaluator.pin(loop.cut(loop.carried[i]), places[i]);
    int left = loop.in_next_turn ? 2 : 1;
    const auto visit = [&](uint32_t block) {
        if (block == loop.latch)
            evaluator.unpin();
        return block != loop.test || --left > 0;
    };
    const Ended ended = evaluator.run(decisions, visit, loop.header, loop.entry);
    evaluator.unpin();
    return ended;
}

template <class System, class Real>
typename System::Value number_of(const Point<Real>& point, Scalar type) {
    return type == Scalar::real ? System::number(double(point.real)) : System::constant(point.bits, type);
}

Interval difference(const Interval& distance, const Interval& threshold) {
    return distance - threshold;
}
Tangent difference(const Tangent& distance, const Tangent& threshold) {
    return {distance.value - threshold.value, distance.slope - threshold.slope};
}

} // namespace

template <class System>
template <class Real>
MarchSlice::Over<System>::Over(const Function& function, const PointEvaluator<Real>& entered)
    : evaluator(function) {
    evaluator.most_steps = k_most_steps;
    for (Value value = 0; value < function.instructions.size(); ++value)
        evaluator.value(value) = number_of<System>(entered.value(value), function.instructions[value].type);
    for (size_t cell = 0; cell < function.cells.size(); ++cell)
        memory.push_back(number_of<System>(entered.memory()[cell], function.cells[cell]));
}

template <class Real>
MarchSlice::MarchSlice(const Function& function, const MarchingLoop& loop,
                       const PointEvaluator<Real>& entered, Textures<Interval> textures, Surface surface)
    : loop_(&loop), surface_(surface), intervals_(function, entered), tangents_(function, entered) {
    tangents_.evaluator.textures = [textures](const Lookup& lookup, std::span<const Tangent> operands) {
        std::vector<Interval> places;
        for (const Tangent& operand : operands)
            places.push_back(operand.value);
        const bool constant = std::ranges::all_of(operands, &Tangent::constant);
        return Tangent{textures ? textures(lookup, places) : everything(),
                       constant ? Interval{} : everything()};
    };
    intervals_.evaluator.textures = std::move(textures);
    for (const Carried& each : loop.carried) {
        const bool itself = loop.by_parameter();
        first_.push_back(itself ? 0 : entered.value(each.phi).real);
        factor_.push_back(itself || each.factor == k_no_value ? 1 : entered.value(each.factor).real);
    }
    start_ = loop.by_parameter() ? entered.value(loop.carried[0].phi).real : 0;
}
template MarchSlice::MarchSlice(const Function&, const MarchingLoop&, const PointEvaluator<float>&,
                                Textures<Interval>, Surface);
template MarchSlice::MarchSlice(const Function&, const MarchingLoop&, const PointEvaluator<double>&,
                                Textures<Interval>, Surface);

double MarchSlice::parameter(const Turn& turn) const {
    size_t longest = 0;
    for (size_t i = 1; i < factor_.size(); ++i)
        if (std::abs(factor_[i]) > std::abs(factor_[longest]))
            longest = i;
    return (turn.carried[longest] - first_[longest]) / factor_[longest];
}

double MarchSlice::unit() const {
    if (std::ranges::any_of(loop_->carried, [](const Carried& each) { return each.factor == k_no_value; }))
        return 1;
    double squares = 0;
    for (const double factor : factor_)
        squares += factor * factor;
    return std::sqrt(squares);
}

template <class System>
std::optional<typename System::Value> MarchSlice::run(Over<System>& over,
                                                      const std::vector<typename System::Value>& places,
                                                      Decisions& decisions, Surface surface) {
    over.evaluator.memory() = over.memory;
    const Ended ended = run_to_test(over.evaluator, *loop_, places, decisions);
    evaluations_ += 1 + over.evaluator.steps() / k_long_run;
    if (ended == Ended::left || ended == Ended::discarded)
        return std::nullopt;
    if (ended != Ended::stopped)
        return System::unknown();
    return difference(over.evaluator.value(loop_->distance),
                      surface == Surface::zero ? System::number(0) : over.evaluator.value(loop_->threshold));
}

double MarchSlice::end(const March& march) const {
    constexpr double k_beyond = 1.5; // a hit that is a little early is still found
    if (loop_->limited())
        return march.far;
    return start_ + (march.hit ? k_beyond : 1) * (parameter(march.turns.back()) - start_);
}

Interval MarchSlice::place(size_t carried, const Interval& parameter) const {
    if (loop_->by_parameter())
        return parameter;
    return Interval{first_[carried], first_[carried]} +
           Interval{factor_[carried], factor_[carried]} * parameter;
}

std::optional<Interval> MarchSlice::bounds(const Interval& parameter, Care care, Surface surface) {
    std::vector<Interval> places;
    for (size_t i = 0; i < loop_->carried.size(); ++i)
        places.push_back(place(i, parameter));
    intervals_.evaluator.splits = care != Care::quick;
    const int most_ways = care == Care::thorough ? k_many_ways : k_few_ways;
    Decisions decisions(k_most_decisions);
    std::optional<Interval> all;
    for (int way = 0; way == 0 || decisions.next(); ++way) {
        const auto one = run(intervals_, places, decisions, surface);
        if (way == most_ways || decisions.exhausted())
            return everything(false); // too many ways: too many jumps
        if (one)
            all = all ? hull(*all, *one) : *one;
    }
    return all;
}

std::optional<Tangent> MarchSlice::tangent(const Interval& parameter) {
    std::vector<Tangent> places;
    for (size_t i = 0; i < loop_->carried.size(); ++i)
        places.push_back({place(i, parameter), {factor_[i], factor_[i]}});
    Decisions none(0);
    auto found = run(tangents_, places, none, surface_);
    const bool known = found && !none.exhausted() && !found->value.partial && std::isfinite(found->slope.low);
    return known ? found : std::nullopt;
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

March follow(FloatEvaluator& evaluator, const Function& function, const MarchingLoop& loop) {
    March march;
    const auto carried = [&] {
        std::vector<float> values;
        for (const Carried& each : loop.carried)
            values.push_back(evaluator.value(loop.cut(each)).real);
        return values;
    };
    std::vector<float> before;
    const std::vector<bool> inside = natural_loop(function, loop.header);
    const auto visit = [&](uint32_t block) {
        if (!inside[block])
            return false;
        if (block == loop.test && (!loop.in_next_turn || !before.empty())) {
            march.threshold = evaluator.value(loop.threshold).real;
            march.turns.push_back({loop.in_next_turn ? before : carried(),
                                   evaluator.value(loop.distance).real - march.threshold});
        }
        if (block == loop.latch)
            before = carried();
        return true;
    };
    if (loop.far != k_no_value)
        march.far = evaluator.value(loop.far).real;
    Decisions none(0);
    evaluator.run(none, visit, loop.header, loop.entry);
    if (!march.turns.empty()) {
        const float last = march.turns.back().distance;
        march.hit = loop.at_equality ? last <= 0 : last < 0;
    }
    return march;
}

bool is_faithful(const MarchingLoop& loop, const FloatEvaluator& entered, const March& march) {
    FloatEvaluator evaluator = entered;
    for (const Turn& turn : march.turns) {
        evaluator.memory() = entered.memory();
        std::vector<Point<float>> places;
        for (const float each : turn.carried)
            places.push_back({each, 0});
        Decisions none(0);
        if (run_to_test(evaluator, loop, places, none) != Ended::stopped)
            return false;
        const float distance = evaluator.value(loop.distance).real - evaluator.value(loop.threshold).real;
        if (std::bit_cast<uint32_t>(distance) != std::bit_cast<uint32_t>(turn.distance))
            return false;
    }
    return true;
}

} // namespace tidemark::ir
