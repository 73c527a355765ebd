#include "ir/idle_turn.hpp"

#include <algorithm>

namespace tidemark::ir {
namespace {

bool stores(const Function& function, const Block& block) {
    const auto first = function.instructions.begin();
    return std::any_of(first + block.first, first + block.last,
                       [](const Instruction& each) { return each.op == Op::store; });
}

} // namespace

std::optional<IdleTurn> IdleTurn::find(const LoopBlocks& loop, const Cone& cone, uint32_t block, size_t way) {
    const Function& function = loop.function;
    IdleTurn turn;
    uint32_t at = function.blocks[block].successors[way];
    turn.edges_.push_back({at, block});
    while (at != loop.header) {
        const Block& here = function.blocks[at];
        if (here.end != Block::End::jump || stores(function, here))
            return std::nullopt;
        turn.edges_.push_back({here.successors[0], at});
        at = here.successors[0];
    }
    bool real = false;
    for (const Value phi : cone.of(function.blocks[block].condition)) {
        if (!loop.is_header_phi(phi))
            continue;
        if (turn.idle(loop, function.operands_of(function.instructions[phi])[loop.back_slot]) != phi)
            return std::nullopt;
        real = real || function.instructions[phi].type == Scalar::real;
    }
    return real ? std::optional(std::move(turn)) : std::nullopt;
}

/// Returns the index of the phi's operand on the idle path; nullopt if the path does not enter its block.
std::optional<size_t> IdleTurn::slot_of(const LoopBlocks& loop, Value phi) const {
    const Instruction& instruction = loop.function.instructions[phi];
    if (instruction.op != Op::phi || loop.is_header_phi(phi))
        return std::nullopt;
    const auto edge = std::ranges::find(edges_, loop.block_of[phi], &Edge::to);
    if (edge == edges_.end())
        return std::nullopt;
    const auto& predecessors = loop.function.blocks[edge->to].predecessors;
    return size_t(std::ranges::find(predecessors, edge->from) - predecessors.begin());
}

Value IdleTurn::idle(const LoopBlocks& loop, Value value) const {
    while (const auto slot = slot_of(loop, value))
        value = loop.function.operands_of(loop.function.instructions[value])[*slot];
    return value;
}

Value IdleTurn::busy(const LoopBlocks& loop, Value value) const {
    while (const auto slot = slot_of(loop, value)) {
        const auto operands = loop.function.operands_of(loop.function.instructions[value]);
        if (operands.size() != 2)
            break;
        value = operands[1 - *slot];
    }
    return value;
}

} // namespace tidemark::ir
