// Finds the longest safe step of a march, as a multiple of the distance that it measures.
#pragma once

#include "ir/march_slice.hpp"

#include <cstdint>

namespace tidemark::ir {

struct StepScale {
    /// A step of at most this multiple of the distance does not pass the first hit, from any place before the
    /// hit whose distance is above the threshold. 0: not known.
    double safe = 0;
    /// A step longer than this multiple, from `at`, passes the hit.
    double unsafe = k_infinity;
    double at = 0;
};

/// Largest multiple of interest: longer safe steps are not searched for.
inline constexpr double k_longest_scale = 4;

/// `slice` must use Surface::zero; `hit` is its first zero, from first_hit.
StepScale step_scale(MarchSlice& slice, const Interval& hit, uint64_t most_evaluations);

} // namespace tidemark::ir
