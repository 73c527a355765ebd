// One iteration of a marching loop as a Function of its own: only the instructions that the tested distance
// depends on (program slicing: M. Weiser, IEEE Transactions on Software Engineering 10, 1984). Values that
// are constant along a ray are computed before it (loop-invariant code motion).
#pragma once

#include "ir/marching_loop.hpp"

#include <vector>

namespace tidemark::ir {

struct LoopSlice {
    MarchingLoop loop; ///< in the whole function
    /// Block 0 computes the values that are constant along a ray, then jumps to the header.
    Function function;
    MarchingLoop turn; ///< the loop in `function`, without factors and limit
    /// the values of the whole function that the first instructions of `function` stand for
    std::vector<Value> inputs;
    std::vector<uint32_t> cells; ///< the cells of the whole function that the cells of `function` stand for
    bool stores = false; ///< an iteration writes to memory
};

/// End of a slice.
enum class SliceOf {
    distance, ///< up to the test
    step ///< and on to the step that is added to the ray's parameter; `advance` of the loop has to be known
};

LoopSlice slice_of(const Function& function, const MarchingLoop& loop, SliceOf what = SliceOf::distance);

} // namespace tidemark::ir
