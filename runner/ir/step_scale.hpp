// How long the steps of a march may be: by what multiple of the distance that it measures.
#pragma once

#include "ir/march_slice.hpp"

#include <cstdint>

namespace tidemark::ir {

struct StepScale {
    /// A step of at most so many times the distance, from wherever in front of the first hit the distance is
    /// above the threshold, does not go past that hit. 0: not known.
    double safe = 0;
    /// A longer one than that, from `at`, does.
    double unsafe = k_infinity;
    double at = 0;
};

/// Nobody steps further than that many times the distance: what is safe beyond is not looked for.
inline constexpr double k_longest_scale = 4;

/// `slice` is of Surface::zero, `hit` its first zero as first_hit has it.
StepScale step_scale(MarchSlice& slice, const Interval& hit, uint64_t most_evaluations);

} // namespace tidemark::ir
