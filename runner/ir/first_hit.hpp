// The first place on a ray where its field falls below the threshold, by branch and bound over intervals:
// what is passed over is proved to have none.
#pragma once

#include "ir/march_slice.hpp"

#include <string_view>

namespace tidemark::ir {

struct FirstHit {
    enum class Verdict {
        hit,      ///< the first one lies in `where`
        none,     ///< there is none up to `where.high`
        undecided ///< there is none before `where.low`; what is in `where` is not known
    } verdict = Verdict::undecided;
    enum class Reason { none, not_finite, jump, grazing, budget } reason = Reason::none;
    Interval where{};
    uint64_t evaluations = 0;
};

inline constexpr size_t k_reasons = size_t(FirstHit::Reason::budget) + 1;
std::string_view to_string(FirstHit::Reason reason);

/// How far a hit is narrowed down, relative to the parameter.
inline constexpr double k_usual_width = 4e-6;

/// From the slice's start to `last`, which does not lie in front of it, in terms of the ray's parameter.
/// Where one of them is NaN or infinite, all is undecided.
FirstHit first_hit(MarchSlice& slice, double last, uint64_t most_evaluations = 20'000,
                   double relative_width = k_usual_width);

} // namespace tidemark::ir
