// The common part of requests to, and results of, searches for a better scene.
#pragma once

#include "base/extent.hpp"
#include "lab/study/conduct.hpp"
#include "lab/tune/goal.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

struct SearchRequest {
    Goal goal{};
    Extent extent{320, 180}; ///< of the verdict's pictures
    std::vector<View> views{}; ///< used by the search; the verdict has more
    double seconds = 60; ///< for everything
};

struct SearchOutcome {
    Findings findings; ///< of the last study: the unchanged scene, and the results of the search
    std::vector<std::string> sentences{}; ///< for the user, in this order
};

} // namespace tidemark::lab
