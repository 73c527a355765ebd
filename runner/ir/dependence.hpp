// Data dependence between instructions, and the blocks that belong to a loop. Input for program slicing;
// nothing is changed.
#pragma once

#include "ir/function.hpp"

#include <vector>

namespace tidemark::ir {

bool overlap(const Access& a, const Access& b);

/// Returns the index of the block of each instruction; 0 for constants.
std::vector<uint32_t> blocks_of_instructions(const Function& function);

/// Returns, for each block, whether it lies on a path from the loop's header back to it.
std::vector<bool> natural_loop(const Function& function, uint32_t header);

/// Returns the natural loop and the blocks in the loop's source text that leave it, such as the one before a
/// `break`. Returns an empty vector if no block leads back to the header.
std::vector<bool> text_of_loop(const Function& function, uint32_t header);

/// The instructions of a loop that a value is computed from (backward slice within the loop).
class Cone {
public:
    /// `inside[i]` is true if instruction i is in the loop. The header's phis and the values in `stops` are
    /// in the cone, but nothing that they are computed from.
    Cone(const Function& function, const std::vector<bool>& inside, uint32_t header,
         std::vector<Value> stops = {});

    /// Returns the cone of `value`, sorted.
    std::vector<Value> of(Value value) const;
    /// Returns the direct sources of a value in the loop: its operands, and for a load also the stores in the
    /// loop that may write the same cells.
    std::vector<Value> sources(Value value) const;

private:
    const Function* function_;
    const std::vector<bool>* inside_;
    std::vector<Value> stores_; ///< stores in the loop
    uint32_t first_phi_, last_phi_;
    std::vector<Value> stops_;
};

} // namespace tidemark::ir
