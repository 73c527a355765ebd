// Idle iterations of a loop: a loop whose whole body is `if (distance > eps) { … }`, without a `break`, has
// ended once the condition fails, although it continues to iterate.
#pragma once

#include "ir/dependence.hpp"

#include <optional>
#include <vector>

namespace tidemark::ir {

struct LoopBlocks {
    const Function& function;
    const std::vector<uint32_t>& block_of; ///< of instructions
    uint32_t header;
    size_t back_slot; ///< index of the phi operand that comes from the previous iteration

    bool is_header_phi(Value value) const {
        return function.instructions[value].op == Op::phi && block_of[value] == header;
    }
};

class IdleTurn {
public:
    /// Checks whether `block`, which branches within the loop, makes an iteration idle: the path to its
    /// successor `way`, and on to the header, changes no value that the branch depends on, so no later
    /// iteration does. Returns nullopt if it does not. `cone` is the loop's.
    static std::optional<IdleTurn> find(const LoopBlocks& loop, const Cone& cone, uint32_t block, size_t way);

    /// Returns the value that `value` has in an iteration that is not idle.
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
