// How often a loop turns that counts: from one number of the text, by another, up to a third.
#pragma once

#include "ir/function.hpp"

#include <cstdint>
#include <optional>

namespace tidemark::ir {

/// What a loop carries, and ends it where `smaller` is below `larger`.
struct LoopCounter {
    Value phi, first, next;
    Value smaller, larger;
    bool at_equality; ///< and where they are equal
};

/// Whole turns before it ends the loop; nothing where it counts otherwise, or for very long.
std::optional<uint32_t> turns_of(const Function& function, const LoopCounter& counter);

} // namespace tidemark::ir
