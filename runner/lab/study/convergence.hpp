// Estimates the distance of a ladder of ever stricter settings from its limit, by the change at each rung.
// Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The change that all further rungs together would make; nullopt, with the reason, if it cannot be
/// estimated.
struct Remainder {
    std::optional<double> error{};
    std::string how{}; ///< the numbers it comes from, or the reason why there is none
    bool still = false; ///< the last change is only rounding
};

/// `changes` holds the change of each rung from the one before, the strictest last; each rung is stricter by
/// the same factor. The estimate is the sum of the changes to come, extrapolated from their ratios: change r
/// / (1 - r) if the ratio r of the last two stays constant, which is exact for any power of the setting; more
/// if r itself rises, as the third last change shows (exact for powers of the setting's logarithm). It is
/// nullopt if r is 1 or more, and for fewer than two changes. Changes up to `rounding` count as zero.
Remainder remainder_of(const std::vector<double>& changes, double rounding);

} // namespace tidemark::lab
