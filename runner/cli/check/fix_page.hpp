// The cures of `tidemark check --fix -o` as a page for people: each with what was measured and the difference
// that it is. Text out.
#pragma once

#include <span>
#include <string>

namespace tidemark::cli {

/// A cure as it was told (cli/check/fix_text.hpp), and what it changes in files.
struct CureCard {
    std::string finding;
    std::string text; ///< the finding's sentence, then what was measured
    std::string difference;
};

/// What is not mended, and why.
struct RemainingCard {
    std::string finding;
    std::string why;
};

/// `cut`: why there may be more; empty: it came to its end.
std::string fix_page(const std::string& scene, std::span<const CureCard> cures,
                     std::span<const RemainingCard> remaining, const std::string& cut);

} // namespace tidemark::cli
