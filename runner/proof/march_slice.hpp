// Runs one iteration of a marching loop over a number system, as often as needed. Everything but the places
// on the ray is as it was when a pixel entered the loop.
#pragma once

#include "proof/evaluate.hpp"
#include "proof/loops.hpp"
#include "proof/number_systems.hpp"
#include "proof/point.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <vector>

namespace tidemark::proof {

template <class Real>
using PointEvaluator = Evaluator<PointSystem<Real>>;
using FloatEvaluator = PointEvaluator<float>;

template <class System>
class LoopTurn {
public:
    using Number = typename System::Value;

    template <class Entered>
    LoopTurn(const LoopSlice& slice, const Evaluator<Entered>& entered, Textures<Number> textures = {})
        : turn_(&slice.turn), stores_(slice.stores), leave_(uint32_t(slice.function.blocks.size()) - 1),
          evaluator_(slice.function) {
        evaluator_.textures = std::move(textures);
        for (Value i = 0; i < slice.inputs.size(); ++i)
            if (const Instruction& input = slice.function.instructions[i]; input.op != Op::constant)
                evaluator_.value(i) = number_of(entered.value(slice.inputs[i]), input.type);
        for (size_t i = 0; i < slice.cells.size(); ++i)
            evaluator_.memory()[i] = number_of(entered.memory()[slice.cells[i]], slice.function.cells[i]);
        if (stores_)
            memory_ = forget_stored(slice.function, evaluator_.memory());
        compute_invariants(slice.function.blocks[0]);
    }

    Evaluator<System>& evaluator() { return evaluator_; }

    /// Runs at those places up to the test of the distance; returns Ended::stopped if it was reached. If the
    /// test belongs to the next iteration, that one computes its own places, as the text does.
    Ended run(const std::vector<Number>& places, Decisions& decisions) {
        set_out(places);
        int left = turn_->in_next_turn ? 2 : 1;
        const auto visit = [&](uint32_t block) {
            if (block == turn_->latch)
                evaluator_.unpin();
            return block != turn_->test || --left > 0;
        };
        const Ended ended = evaluator_.run(decisions, visit, first_block_, turn_->entry);
        evaluator_.unpin();
        return ended;
    }
    /// Runs a slice that includes the step: through the test, to the amount that is then added to the ray's
    /// parameter. Returns Ended::stopped if the loop continues.
    Ended step(const std::vector<Number>& places, Decisions& decisions) {
        set_out(places);
        bool again = false, tested = false;
        const auto visit = [&](uint32_t block) {
            if (tested && block != leave_)
                return false;
            if (block == turn_->test)
                stay();
            tested = again && turn_->in_next_turn && !turn_->cut_at_update && block == turn_->test;
            if (again && turn_->cut_at_update && block == turn_->step) {
                advance_ = evaluator_.value(turn_->advance);
                return false;
            }
            if (block != turn_->latch || again)
                return true;
            again = true;
            evaluator_.unpin();
            advance_ = evaluator_.value(turn_->advance);
            return turn_->cut_at_update || turn_->in_next_turn;
        };
        const Ended ended = evaluator_.run(decisions, visit, first_block_, turn_->entry);
        evaluator_.unpin();
        return ended;
    }
    const Number& advance() const { return advance_; }
    const Number& distance() const { return evaluator_.value(turn_->distance); }
    const Number& threshold() const { return evaluator_.value(turn_->threshold); }

private:
    /// Applies that the distance is not below the threshold if the loop continues.
    void stay() {
        if constexpr (std::is_same_v<Number, Interval>)
            if (turn_->at_hit) {
                Interval& distance = evaluator_.value(turn_->distance);
                distance.low = std::max(distance.low, threshold().low);
                distance.high = std::max(distance.low, distance.high);
            }
    }

    /// Memory that an iteration leaves for the next one is known only at the places of the march itself.
    static std::vector<Number> forget_stored(const Function& function, std::vector<Number> memory) {
        for (const Instruction& each : function.instructions)
            if (each.op == Op::store) {
                const Access& access = function.accesses[each.immediate];
                std::fill_n(memory.begin() + access.first, access.size, System::unknown());
            }
        return memory;
    }

    void set_out(const std::vector<Number>& places) {
        if (stores_)
            evaluator_.memory() = memory_;
        for (size_t i = 0; i < turn_->carried.size(); ++i)
            evaluator_.pin(turn_->cut(turn_->carried[i]), places[i]);
    }

    template <class Real>
    static Number number_of(const Point<Real>& point, Scalar type) {
        if constexpr (std::is_same_v<Number, Point<Real>>)
            return point;
        else
            return type == Scalar::real ? System::number(double(point.real))
                                        : System::constant(point.bits, type);
    }
    static Number number_of(const Interval& interval, Scalar) {
        if constexpr (std::is_same_v<Number, Interval>)
            return interval;
        else
            return {interval, {}};
    }

    /// Computes the invariants once for all iterations. If one of them may be split at a jump, each iteration
    /// computes them again instead.
    void compute_invariants(const Block& block) {
        Decisions none(0);
        evaluator_.run(none, [](uint32_t) { return false; });
        first_block_ = turn_->header;
        for (Value value = block.first; value < block.last; ++value)
            if (System::may_be_split(evaluator_.value(value)))
                first_block_ = 0;
    }

    const MarchingLoop* turn_;
    bool stores_;
    uint32_t leave_; ///< the block after the loop
    Evaluator<System> evaluator_;
    Number advance_{};
    std::vector<Number> memory_{}; ///< the memory on entry of the loop, if an iteration changes it
    uint32_t first_block_ = 0;
};

// The distance that a marching loop tests, as a function of the ray's parameter alone; everything else is as
// it was when a pixel entered the loop. Evaluated over intervals, it bounds the field on a piece of the ray.

/// One iteration of the loop as the text runs it, in float.
struct Turn {
    std::vector<float> carried; ///< values of MarchingLoop::carried at which the distance is measured
    float measured = 0;         ///< the distance
    float threshold = 0;

    float distance() const { return measured - threshold; } ///< margin above the threshold
};

/// The march of one pixel.
struct March {
    std::vector<Turn> turns;
    std::optional<float> far{}; ///< the loop's limit; nullopt if it has none or it is not finite
    bool hit = false;           ///< the distance ended the march
};

/// Treatment of undecided conditions and jumps: `quick` accepts wider bounds; `close` and `thorough`
/// enumerate the paths, up to 32 or 2048 of them.
enum class Care { quick, close, thorough };

/// Definition of a hit: the loop's own test holds, or the distance itself is below 0.
enum class Surface { threshold, zero };

/// Returns the interval from `parameter` to the next double. An interval of a single number would be taken
/// for a float, and computed with a float's rounding.
inline Interval place_at(double parameter) {
    return std::isfinite(parameter) ? Interval{parameter, std::nextafter(parameter, k_infinity)}
                                    : everything();
}

/// The field along one ray, or along all rays of an area and a time span at once if `entered` holds
/// intervals. All values but the ray's parameter are those of `entered`, which has run up to the loop's
/// entry.
class MarchSlice {
public:
    template <class System>
    MarchSlice(const LoopSlice& slice, const Evaluator<System>& entered,
               const Textures<Interval>& textures = {}, Surface surface = Surface::threshold);

    /// Returns the ray's start as a value of its parameter; the least one for several rays. Returns -infinity
    /// if the start may be NaN or infinite.
    double start() const { return start_; }
    /// Returns the ray's parameter at which an iteration measured the distance.
    double parameter(const Turn& turn) const;
    /// Returns the length on the ray of one unit of the parameter: 1 if the loop carries the parameter
    /// itself. For several rays, returns a lower bound.
    double unit() const;
    /// Returns the end of the search for a first hit: the loop's limit; else the last place of the march, and
    /// half as far again if it ended in a hit. A march without a limit may go to infinity.
    double end(const March& march) const;
    /// Returns the largest limit of the loop; nullopt unless all rays have a finite one.
    std::optional<double> far() const { return far_; }

    /// Returns bounds, over a piece of the ray, of a value that is negative past the surface; `partial` if it
    /// may be NaN or infinite. Returns nullopt if the loop is left before it measures.
    std::optional<Interval> distance(const Interval& parameter, Care care);
    /// The same bounds, and those of the distance above the loop's threshold, for either kind of surface.
    struct Distances {
        Interval own;
        Interval above_threshold;
    };
    std::optional<Distances> distances(const Interval& parameter, Care care);
    /// Returns the bounds of the distance and of its slope if all conditions are decided and nothing jumps,
    /// else nullopt.
    std::optional<Tangent> tangent(const Interval& parameter);
    /// Returns bounds of the slope on both sides of all jumps, over all paths; nullopt if they are not known.
    std::optional<Interval> slope_beside_jumps(const Interval& parameter);

    /// Requires a slice with the step. Returns bounds of the amount that an iteration adds to the parameter
    /// if the loop continues from a place of the piece; nullopt if the loop is left from all of them.
    std::optional<Interval> advance(const Interval& parameter, Care care);

    /// For a result of `distance`: whether no place of the piece is a hit, or every place is.
    bool excludes_hit(const std::optional<Interval>& distance) const;
    bool is_hit(const std::optional<Interval>& distance) const;
    /// Returns the number of iterations run so far; a very long one counts as several.
    uint64_t evaluations() const { return evaluations_; }

private:
    /// The two operands of the loop's test.
    template <class Number>
    struct Compared {
        Number distance, threshold;
    };
    template <class System>
    std::optional<Compared<typename System::Value>>
    run(LoopTurn<System>& turn, const std::vector<typename System::Value>& places, Decisions& decisions);
    Interval place(size_t carried, const Interval& parameter) const;
    std::vector<Interval> places(const Interval& parameter) const;
    std::vector<Tangent> moving_places(const Interval& parameter) const;
    Tangent own(const Compared<Tangent>& found) const;
    void set(Care care) { intervals_.evaluator().splits = care != Care::quick; }

    const MarchingLoop* loop_;
    Surface surface_;
    LoopTurn<IntervalSystem> intervals_;
    LoopTurn<TangentSystem> tangents_;
    std::vector<Interval> first_, factor_;
    double start_ = 0;
    std::optional<double> far_;
    uint64_t evaluations_ = 0;
};

/// The distance itself, in float: the value that the text computes when its march reaches that place.
class FloatField {
public:
    FloatField(const LoopSlice& slice, const FloatEvaluator& entered);

    /// Returns the distance at a ray's parameter, as defined by MarchSlice; nullopt if the loop is left
    /// before it measures.
    std::optional<float> distance(double parameter);

private:
    LoopTurn<PointSystem<float>> turn_;
    bool by_parameter_;
    std::vector<float> first_, factor_;
};

/// Runs the pixel that `evaluator` is set up for until it enters one of the loops. Returns the loop's index;
/// nullopt if the pixel enters none, or if the path is not decided.
template <class System>
std::optional<size_t> enter_first(Evaluator<System>& evaluator, const std::vector<MarchingLoop>& loops) {
    Decisions none(0);
    std::optional<size_t> entered;
    const auto visit = [&](uint32_t block) {
        for (size_t i = 0; i < loops.size(); ++i)
            if (block == loops[i].header)
                entered = i;
        return !entered;
    };
    evaluator.run(none, visit);
    return entered;
}

/// Continues from the loop's entry through the loop, and returns all iterations that measured a distance.
March follow(FloatEvaluator& evaluator, const Function& function, const MarchingLoop& loop);
/// Like `follow`, but the loop's counters do not end it: it takes up to `most` iterations.
March follow_on(FloatEvaluator& evaluator, const Function& function, const MarchingLoop& loop, uint32_t most);

/// Returns whether the slice, at the text's own places, has the text's own distances and thresholds bit by
/// bit. If not, the loop carries another value that changes them. A threshold that changes with the
/// iterations may be above that of the slice.
bool is_faithful(const LoopSlice& slice, const FloatEvaluator& entered, const March& march);

} // namespace tidemark::proof
