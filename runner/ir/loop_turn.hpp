// Runs one iteration of a marching loop over a number system, as often as needed. Everything but the places
// on the ray is as it was when a pixel entered the loop.
#pragma once

#include "ir/evaluate.hpp"
#include "ir/interval_system.hpp"
#include "ir/loop_slice.hpp"
#include "ir/point.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace tidemark::ir {

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

} // namespace tidemark::ir
