// What can be left out of a scene within a stated error: cuts of its texts, each drawn and timed, combined as
// long as the picture stays near to that of the scene as it is, and judged at moments that no search saw. A
// context must be current.
#pragma once

#include "glsl/cure/cure.hpp"
#include "lab/study/conduct.hpp"
#include "lab/tune/goal.hpp"

#include <functional>
#include <string>
#include <vector>

namespace tidemark::lab {

struct SimplifyRequest {
    Goal goal{Measure::flip, 0.01, {}}; ///< against the scene as it is; 0: every byte stays
    Extent extent{320, 180};            ///< that the verdict is about
    std::vector<View> views{};          ///< that are searched; the verdict has more
    double seconds = 60;                ///< for all of it
    std::function<bool(const glsl::Cure&)> can_be_written; ///< into the scene's own files
};

/// A cut that was chosen.
struct ChosenCut {
    glsl::Cure change;
    double error = 0; ///< of it alone, in the searched pictures
    double time = 1;  ///< of a frame with it alone, as a part of that without
};

struct Simplified {
    Findings findings;                    ///< the scene as it is, and what the search went through
    std::vector<ChosenCut> chosen{};      ///< in the order in which they were found; empty: none pays
    std::vector<std::string> sentences{}; ///< what to tell, in its order
};

/// Fails (ErrorCode::check_failed) where nothing can be said, as for a picture that is no numbers.
Result<Simplified> simplify(const scene::Scene& scene, const SimplifyRequest& request, const Watch& watch,
                            const Circumstances& circumstances);

} // namespace tidemark::lab
