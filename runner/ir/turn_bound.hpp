// Bounds the number of iterations of a march from above, by the least length of each of its steps.
#pragma once

#include "ir/march_slice.hpp"

#include <cstdint>
#include <optional>

namespace tidemark::ir {

/// Returns a number of iterations after which the march has certainly reached a hit or `end`, in real
/// arithmetic; nullopt if that is not known, or is more than `enough`. `slice` must use SliceOf::step; for
/// several rays the bound holds for each.
std::optional<uint32_t> most_turns(MarchSlice& slice, double end, uint32_t enough, uint64_t most_evaluations);

} // namespace tidemark::ir
