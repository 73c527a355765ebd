// Iteration count of a counting loop: from one constant, by a second, up to a third.
#pragma once

#include "ir/function.hpp"

#include <cstdint>
#include <optional>

namespace tidemark::ir {

/// A value that the loop carries; it ends the loop once `smaller` is below `larger`.
struct LoopCounter {
    Value phi, first, next;
    Value smaller, larger;
    bool at_equality; ///< also ends it if they are equal
};

/// Returns the number of full iterations before it ends the loop; nullopt if it counts otherwise, or for over
/// a million iterations.
std::optional<uint32_t> turns_of(const Function& function, const LoopCounter& counter);

} // namespace tidemark::ir
