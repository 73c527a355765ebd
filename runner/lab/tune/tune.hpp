// The settings of a scene that keep an error in the least time, or a time with the least error: explored one
// by one on small pictures, combined by a model, then measured against the scene as it is. A context must be
// current.
#pragma once

#include "lab/study/conduct.hpp"
#include "lab/tune/goal.hpp"
#include "lab/tune/quality_settings.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

struct TuneRequest {
    Goal goal{};
    Extent extent{320, 180};   ///< that the verdict is about
    std::vector<View> views{}; ///< that are searched; the verdict has one more
    std::vector<QualitySetting> settings{};
    double seconds = 60; ///< for all of it
};

struct Tuned {
    Findings findings;                    ///< of the last study: the scene as it is, and the candidates
    std::vector<Setting> chosen{};        ///< empty: nothing that was found is better, or it cannot be said
    std::vector<std::string> sentences{}; ///< what to tell, in its order
};

/// The error (ErrorCode::check_failed) says why nothing can be said.
Result<Tuned> tune(const scene::Scene& scene, TuneRequest request, const Watch& watch,
                   const Circumstances& circumstances);

/// Where the march of Image tests its distance; none where none is found.
std::optional<SourceLocation> march_test(const scene::Scene& scene);

} // namespace tidemark::lab
