// One turn of a marching loop as a Function of its own: what the distance that it tests is computed from, and
// nothing else (program slicing: M. Weiser, IEEE Transactions on Software Engineering 10, 1984). What is the
// same all along a ray is computed in front of it (loop-invariant code motion).
#pragma once

#include "ir/marching_loop.hpp"

#include <vector>

namespace tidemark::ir {

struct LoopSlice {
    MarchingLoop loop; ///< in the whole function
    /// Block 0 has what does not change along a ray; it leads to the header.
    Function function;
    MarchingLoop turn;         ///< the loop in `function`; it has no factors and no limit
    std::vector<Value> inputs; ///< of the first instructions of `function`: those of the whole that they are
    std::vector<uint32_t> cells; ///< of the cells of `function`: those of the whole
    bool stores = false;         ///< a turn changes the memory
};

/// What a slice is to compute.
enum class SliceOf {
    distance, ///< up to the test
    step      ///< and what the turn then adds to the ray's parameter: of a loop whose `advance` is known
};

LoopSlice slice_of(const Function& function, const MarchingLoop& loop, SliceOf what = SliceOf::distance);

} // namespace tidemark::ir
