// What a search for a better scene is asked, and what each of them ends with.
#pragma once

#include "base/extent.hpp"
#include "lab/study/conduct.hpp"
#include "lab/tune/goal.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

struct SearchRequest {
    Goal goal{};
    Extent extent{320, 180};   ///< that the verdict is about
    std::vector<View> views{}; ///< that are searched; the verdict has more
    double seconds = 60;       ///< for all of it
};

struct SearchOutcome {
    Findings findings;                    ///< of the last study: the scene as it is, and what was found
    std::vector<std::string> sentences{}; ///< what to tell, in its order
};

} // namespace tidemark::lab
