// What can be left out of a scene within a stated error: cuts of its texts, each drawn and timed, combined as
// long as the picture stays near to that of the scene as it is, and judged at moments that no search saw. A
// context must be current.
#pragma once

#include "glsl/cure/cure.hpp"
#include "lab/tune/search.hpp"

#include <functional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The error is that against the scene as it is; 0: every byte stays.
struct SimplifyRequest : SearchRequest {
    std::function<bool(const glsl::Cure&)> can_be_written; ///< into the scene's own files
};

/// A cut that was chosen.
struct ChosenCut {
    glsl::Cure change;
    double error = 0;           ///< of it alone, in the searched pictures
    double time = 1;            ///< of a frame with it alone, as a part of that without
    bool hangs_on_size = false; ///< as glsl::Cut has it
};

struct Simplified : SearchOutcome {
    std::vector<ChosenCut> chosen{}; ///< in the order in which they were found; empty: none pays
};

/// Fails (ErrorCode::check_failed) where nothing can be said, as where its picture is NaN or infinite.
Result<Simplified> simplify(const scene::Scene& scene, const SimplifyRequest& request, const Watch& watch,
                            const Circumstances& circumstances);

} // namespace tidemark::lab
