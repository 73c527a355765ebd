// Proofs about a ray: its first hit, the safe step, the number of iterations.
//
// Finds the first place on a ray where its field falls below the threshold, by branch and bound over
// intervals. All places skipped are proved to have no hit.
#pragma once

#include "proof/march_slice.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace tidemark::proof {

struct FirstHit {
    enum class Verdict {
        hit,      ///< the first hit lies in `where`
        none,     ///< there is no hit up to `where.high`
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

// Finds the longest safe step of a march, as a multiple of the distance that it measures.

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

// Bounds the number of iterations of a march from above, by the least length of each of its steps.

/// Returns a number of iterations after which the march has certainly reached a hit or `end`, in real
/// arithmetic; nullopt if that is not known, or is more than `enough`. `slice` must use SliceOf::step; for
/// several rays the bound holds for each.
std::optional<uint32_t> most_turns(MarchSlice& slice, double end, uint32_t enough, uint64_t most_evaluations);

} // namespace tidemark::proof
