// Finds what can be left out of a scene within a stated error: cuts of its texts, each drawn and timed,
// combined as long as the picture stays close to the unchanged scene's, and judged at moments that the search
// did not use. Needs a current context.
#pragma once

#include "glsl/cure/cure.hpp"
#include "lab/tune/search.hpp"

#include <functional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The error is measured against the unchanged scene; 0: all bytes stay the same.
struct SimplifyRequest : SearchRequest {
    std::function<bool(const glsl::Cure&)> can_be_written; ///< to the scene's own files
};

/// A cut that was chosen.
struct ChosenCut {
    glsl::Cure change;
    double error = 0; ///< of this cut alone, in the search pictures
    double time = 1; ///< of a frame with this cut alone, as a share of the time without it
    bool hangs_on_size = false; ///< see glsl::Cut
};

struct Simplified : SearchOutcome {
    std::vector<ChosenCut> chosen{}; ///< in the order of their combination; empty: no cut pays
};

/// Fails (ErrorCode::check_failed) if nothing can be measured, for example if the picture is NaN or infinite.
Result<Simplified> simplify(const scene::Scene& scene, const SimplifyRequest& request, const Watch& watch,
                            const Circumstances& circumstances);

} // namespace tidemark::lab
