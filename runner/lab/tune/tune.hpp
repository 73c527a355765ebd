// The settings of a scene that keep an error in the least time, or a time with the least error: explored one
// by one on small pictures, combined by a model, then measured against the scene as it is. A context must be
// current.
#pragma once

#include "lab/tune/quality_settings.hpp"
#include "lab/tune/search.hpp"

#include <optional>
#include <vector>

namespace tidemark::lab {

struct TuneRequest : SearchRequest {
    std::vector<QualitySetting> settings{};
    bool as_it_is = false; ///< errors are held against what the scene shows now, not against a truth
};

struct Tuned : SearchOutcome {
    std::vector<Setting> chosen{}; ///< empty: nothing that was found is better, or it cannot be said
};

/// The error (ErrorCode::check_failed) says why nothing can be said.
Result<Tuned> tune(const scene::Scene& scene, TuneRequest request, const Watch& watch,
                   const Circumstances& circumstances);

/// Nothing where no loop of Image is found to march.
std::optional<MarchPlaces> march_places(const scene::Scene& scene);

} // namespace tidemark::lab
