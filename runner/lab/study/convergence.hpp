// How far a ladder of ever stricter settings still is from where it leads, from what each rung changed. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// What all further rungs together would change; nothing, with the reason, where that cannot be told.
struct Remainder {
    std::optional<double> error{};
    std::string how{};  ///< from which numbers; or why there is none
    bool still = false; ///< the last change is nothing but rounding
};

/// `changes` of each rung from the one before, the strictest last; each rung is stricter by the same factor.
/// The sum of the changes to come, as their ratios go on: change r / (1 - r) where the ratio r of the last
/// two stays, which is exact for any power of the setting; more where r itself rises, as the third last
/// change tells (exact for powers of the setting's logarithm). None where r is 1 or more, and of fewer than
/// two changes. Changes up to `rounding` count as none.
Remainder remainder_of(const std::vector<double>& changes, double rounding);

} // namespace tidemark::lab
