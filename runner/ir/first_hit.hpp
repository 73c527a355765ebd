// Finds the first place on a ray where its field falls below the threshold, by branch and bound over
// intervals. All places skipped are proved to have no hit.
#pragma once

#include "ir/march_slice.hpp"

#include <string_view>

namespace tidemark::ir {

struct FirstHit {
    enum class Verdict {
        hit, ///< the first hit lies in `where`
        none, ///< there is no hit up to `where.high`
        undecided ///< there is no hit before `where.low`; nothing is known about `where`
    } verdict = Verdict::undecided;
    enum class Reason { none, not_finite, jump, grazing, budget } reason = Reason::none;
    Interval where{};
    uint64_t evaluations = 0;
};

inline constexpr size_t k_reasons = size_t(FirstHit::Reason::budget) + 1;
std::string_view to_string(FirstHit::Reason reason);

/// Width to which a hit is narrowed down, relative to the ray's parameter.
inline constexpr double k_usual_width = 4e-6;

/// Searches from the slice's start to `last`, a value of the ray's parameter that is not less than the start.
/// The verdict is `undecided` if either of them is NaN or infinite.
FirstHit first_hit(MarchSlice& slice, double last, uint64_t most_evaluations = 20'000,
                   double relative_width = k_usual_width);

} // namespace tidemark::ir
