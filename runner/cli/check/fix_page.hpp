// The page of `tidemark check --fix -o`: each fix with its measurements and its difference. Returns text.
#pragma once

#include <span>
#include <string>

namespace tidemark::cli {

/// A fix as text (cli/check/fix_text.hpp), and its change of the files.
struct CureCard {
    std::string finding;
    std::string text; ///< the finding's sentence, then the measurements
    std::string difference;
};

/// A finding without a fix, and why.
struct RemainingCard {
    std::string finding;
    std::string why;
};

/// `cut`: why there may be more findings; empty: the run was complete.
std::string fix_page(const std::string& scene, std::span<const CureCard> cures,
                     std::span<const RemainingCard> remaining, const std::string& cut);

} // namespace tidemark::cli
