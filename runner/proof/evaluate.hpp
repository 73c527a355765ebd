// Evaluates a Function over a number system. A system defines a Value and the result of each operation on
// values. If it cannot decide a condition, or an operation jumps within its operand, Decisions choose the
// path; a caller that needs all paths runs the evaluator once for each.
#pragma once

#include "proof/function.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace tidemark::proof {

/// Enumerates the paths through the undecided conditions of a run: the first run takes the first path at each
/// of them, `next` switches to the other path at the last one that has a path left. `most`: how many
/// decisions a run may take.
class Decisions {
public:
    explicit Decisions(size_t most) : most_(most) {}

    /// True once a run needed more than `most` decisions; that run is cancelled.
    bool exhausted() const { return exhausted_; }
    void begin() { at_ = 0; }
    bool decide() {
        if (at_ == ways_.size()) {
            exhausted_ = exhausted_ || ways_.size() == most_;
            ways_.push_back(false);
        }
        return ways_[at_++];
    }
    /// Prepares the next run; false if there is none.
    bool next() {
        ways_.resize(std::min(ways_.size(), at_));
        while (!ways_.empty() && ways_.back())
            ways_.pop_back();
        if (!ways_.empty())
            ways_.back() = true;
        return !ways_.empty() && !exhausted_;
    }

private:
    std::vector<bool> ways_;
    size_t at_ = 0;
    size_t most_;
    bool exhausted_ = false;
};

/// Returns the value of a texture look-up. The operands are the coordinates, then a level, bias or gradients.
template <class Value>
using Textures = std::function<Value(const Lookup& lookup, std::span<const Value> operands)>;

enum class Ended { left, discarded, stopped, too_long, undecided };

template <class System>
class Evaluator {
public:
    using Number = typename System::Value;
    static_assert(std::is_trivially_destructible_v<Number>, "a result is written over what was there");

    Evaluator(const Function& function, System system = {})
        : function_(&function), system_(std::move(system)), values_(function.instructions.size()),
          memory_(function.cells.size()) {
        if (!function.blocks.empty())
            for (uint32_t i = 0; i < function.blocks[0].first; ++i)
                values_[i] =
                    system_.constant(function.instructions[i].immediate, function.instructions[i].type);
    }

    const Number& value(Value of) const { return values_[of]; }
    Number& value(Value of) { return values_[of]; }
    std::vector<Number>& memory() { return memory_; }
    const std::vector<Number>& memory() const { return memory_; }

    /// Number of instructions that the last run executed.
    uint64_t steps() const { return steps_; }

    System& system() { return system_; }

    void unpin() { pinned_.clear(); }
    /// Replaces the result of instruction `at` by `number` in all runs, until unpin().
    void pin(Value at, const Number& number) {
        pinned_.push_back(at);
        values_[at] = number;
    }

    Textures<Number> textures{};
    /// Returns the derivative of an operand along x or y. If this or `textures` is not set, such values are
    /// unknown.
    std::function<Number(Op, Value)> derivative{};
    uint64_t most_steps = 50'000'000; ///< limit of a run, in instructions
    bool splits = false;              ///< also splits operands at jumps, by a decision each

    /// Runs from `block` on, entered from its predecessor `from`. `visit` is called with the index of each
    /// block after it has run, and ends the run by returning false.
    template <class Visit>
    Ended run(Decisions& decisions, Visit visit, uint32_t block = 0, uint32_t from = 0) {
        decisions.begin();
        steps_ = 0;
        while (true) {
            const Block& here = function_->blocks[block];
            enter(block, from);
            execute(here, decisions);
            steps_ += here.last - here.first + 1;
            if (decisions.exhausted())
                return Ended::undecided;
            if (!visit(block))
                return Ended::stopped;
            if (here.end == Block::End::leave || here.end == Block::End::discard)
                return here.end == Block::End::leave ? Ended::left : Ended::discarded;
            if (steps_ > most_steps)
                return Ended::too_long;
            from = std::exchange(block, here.successors[way(here, decisions)]);
        }
    }

    /// Assigns the phis of `block`, entered from `from`, simultaneously.
    void enter(uint32_t block, uint32_t from) {
        const Block& here = function_->blocks[block];
        const auto& predecessors = here.predecessors;
        const auto slot = size_t(std::ranges::find(predecessors, from) - predecessors.begin());
        entering_.clear();
        for (uint32_t i = here.first; i < here.last; ++i) {
            const Instruction& phi = function_->instructions[i];
            if (phi.op != Op::phi)
                break;
            entering_.push_back(values_[function_->operands_of(phi)[slot]]);
        }
        for (uint32_t i = 0; i < entering_.size(); ++i)
            if (!is_pinned(here.first + i))
                values_[here.first + i] = entering_[i];
    }

private:
    bool is_pinned(Value value) const { return std::ranges::find(pinned_, value) != pinned_.end(); }

    void execute(const Block& block, Decisions& decisions) {
        const bool pinned = std::ranges::any_of(
            pinned_, [&](Value value) { return value >= block.first && value < block.last; });
        for (uint32_t i = block.first; i < block.last; ++i)
            if (!pinned || !is_pinned(i))
                execute(i, decisions);
    }
    /// Constructs results in place: copying a result while its members are still being written stalls the
    /// CPU.
    void execute(uint32_t index, Decisions& decisions) {
        const Instruction& instruction = function_->instructions[index];
        const auto operands = function_->operands_of(instruction);
        Number* const result = &values_[index];
        switch (instruction.op) {
        case Op::phi: return;
        case Op::constant:
            new (result) Number(system_.constant(instruction.immediate, instruction.type));
            return;
        case Op::undefined: new (result) Number(system_.constant(0, instruction.type)); return;
        case Op::load: new (result) Number(load(instruction, operands)); return;
        case Op::store: store(instruction, operands); return;
        case Op::texel:
            new (result) Number(textures ? looked_up(instruction, operands) : system_.unknown());
            return;
        case Op::derivative_x:
        case Op::derivative_y:
            new (result) Number(derivative ? derivative(instruction.op, operands[0]) : system_.unknown());
            return;
        default: new (result) Number(computed(instruction, operands, decisions));
        }
    }

    Number computed(const Instruction& instruction, std::span<const Value> operands, Decisions& decisions) {
        static const Number k_zero{};
        const Operands<Number> numbers{values_[operands[0]],
                                       operands.size() > 1 ? values_[operands[1]] : k_zero,
                                       operands.size() > 2 ? values_[operands[2]] : k_zero};
        if (splits)
            if (const auto parts = system_.split(instruction.op, numbers))
                values_[operands[0]] = decisions.decide() ? parts->second : parts->first;
        return system_.compute(instruction.op, instruction.type, function_->instructions[operands[0]].type,
                               numbers);
    }

    Number looked_up(const Instruction& instruction, std::span<const Value> operands) {
        std::vector<Number> numbers;
        for (const Value operand : operands)
            numbers.push_back(values_[operand]);
        return textures(function_->lookups[instruction.immediate], numbers);
    }

    std::pair<uint32_t, uint32_t> cells(const Access& access, std::span<const Value> operands,
                                        size_t offset) {
        if (operands.size() <= offset)
            return {access.first, access.first};
        return access.cells(system_.range(values_[operands[offset]]));
    }
    Number load(const Instruction& instruction, std::span<const Value> operands) {
        const auto [low, high] = cells(function_->accesses[instruction.immediate], operands, 0);
        Number result = memory_[low];
        for (uint32_t cell = low + 1; cell <= high; ++cell)
            result = system_.hull(result, memory_[cell]);
        return result;
    }
    void store(const Instruction& instruction, std::span<const Value> operands) {
        const auto [low, high] = cells(function_->accesses[instruction.immediate], operands, 1);
        const Number& what = values_[operands[0]];
        for (uint32_t cell = low; cell <= high; ++cell)
            memory_[cell] = low == high ? what : system_.hull(memory_[cell], what);
    }

    /// Returns the index of the successor to take.
    size_t way(const Block& block, Decisions& decisions) {
        if (block.end == Block::End::jump)
            return 0;
        const Number& condition = values_[block.condition];
        if (block.end == Block::End::branch) {
            const auto decided = system_.decide(condition);
            return decided ? !*decided : decisions.decide();
        }
        const auto [low, high] = system_.range(condition);
        for (size_t i = 0; i < block.cases.size(); ++i) {
            const int64_t label = int32_t(block.cases[i]);
            if (label < low || label > high)
                continue;
            if (low == high || decisions.decide())
                return i + 1;
        }
        return 0;
    }

    const Function* function_;
    System system_;
    std::vector<Number> values_, memory_;
    std::vector<Number> entering_;
    std::vector<Value> pinned_; ///< few entries
    uint64_t steps_ = 0;
};

} // namespace tidemark::proof
