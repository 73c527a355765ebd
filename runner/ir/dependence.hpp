// Which instructions depend on which, and what belongs to a loop.
#pragma once

#include "ir/function.hpp"

#include <vector>

namespace tidemark::ir {

bool overlap(const Access& a, const Access& b);

/// The block of every instruction; that of constants is 0.
std::vector<uint32_t> blocks_of_instructions(const Function& function);

/// The blocks that lie on a way from the loop's header back to it.
std::vector<bool> natural_loop(const Function& function, uint32_t header);

/// Those, and the ones in the loop's text that lead out of it, as before a `break`; empty where nothing leads
/// back to the header.
std::vector<bool> text_of_loop(const Function& function, uint32_t header);

/// What of a loop a value is computed from.
class Cone {
public:
    /// `inside` says of every instruction whether it is in the loop. Phis of the header and what `stops`
    /// names are in the cone, and nothing beyond them.
    Cone(const Function& function, const std::vector<bool>& inside, uint32_t header,
         std::vector<Value> stops = {});

    /// Sorted.
    std::vector<Value> of(Value value) const;
    /// What a value in the loop is computed from at once: its operands; of a load the stores in the loop,
    /// too, that may have written there.
    std::vector<Value> sources(Value value) const;

private:
    const Function* function_;
    const std::vector<bool>* inside_;
    std::vector<Value> stores_; ///< in the loop
    uint32_t first_phi_, last_phi_;
    std::vector<Value> stops_;
};

} // namespace tidemark::ir
