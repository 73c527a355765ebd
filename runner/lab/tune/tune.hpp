// Finds the settings of a scene that keep an error in the least time, or a time with the least error:
// explored one by one on small pictures, combined by a model, then measured against the unchanged scene.
// Needs a current context.
#pragma once

#include "lab/tune/quality_settings.hpp"
#include "lab/tune/search.hpp"

#include <optional>
#include <vector>

namespace tidemark::lab {

struct TuneRequest : SearchRequest {
    std::vector<QualitySetting> settings{};
    bool as_it_is = false; ///< errors are measured against the unchanged scene, not against a truth
};

struct Tuned : SearchOutcome {
    std::vector<Setting> chosen{}; ///< empty: no better settings were found, or none can be established
};

/// The error (ErrorCode::check_failed) gives the reason why a result is not possible.
Result<Tuned> tune(const scene::Scene& scene, TuneRequest request, const Watch& watch,
                   const Circumstances& circumstances);

/// Returns nullopt if no marching loop is found in Image.
std::optional<MarchPlaces> march_places(const scene::Scene& scene);

} // namespace tidemark::lab
