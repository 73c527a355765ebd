// Turns of a loop that do nothing: where `if (distance > eps) { … }` is all that a loop without a `break`
// has, it has ended, though it goes on turning.
#pragma once

#include "ir/dependence.hpp"

#include <optional>
#include <vector>

namespace tidemark::ir {

struct LoopBlocks {
    const Function& function;
    const std::vector<uint32_t>& block_of; ///< of instructions
    uint32_t header;
    size_t back_slot; ///< of the operand of its phis that comes from the turn before

    bool is_header_phi(Value value) const {
        return function.instructions[value].op == Op::phi && block_of[value] == header;
    }
};

class IdleTurn {
public:
    /// From that block, which branches within the loop: where the way to its successor `way`, and on to the
    /// header, changes nothing of what the branch looks at. No later turn does then. `cone` is the loop's.
    static std::optional<IdleTurn> find(const LoopBlocks& loop, const Cone& cone, uint32_t block, size_t way);

    /// What a turn makes of a value that is not idle.
    Value busy(const LoopBlocks& loop, Value value) const;

private:
    struct Edge {
        uint32_t to, from;
    };
    std::optional<size_t> slot_of(const LoopBlocks& loop, Value phi) const;
    Value idle(const LoopBlocks& loop, Value value) const;

    std::vector<Edge> edges_;
};

} // namespace tidemark::ir
