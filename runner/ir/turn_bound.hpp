// How many turns a march can need at most: by how far each of its steps goes at least.
#pragma once

#include "ir/march_slice.hpp"

#include <cstdint>
#include <optional>

namespace tidemark::ir {

/// Turns after which the march has surely come to a hit or to `end`, in real arithmetic; nothing where that
/// is not known, or is more than `enough`. `slice` is of SliceOf::step; of many rays the turns of each.
std::optional<uint32_t> most_turns(MarchSlice& slice, double end, uint32_t enough, uint64_t most_evaluations);

} // namespace tidemark::ir
