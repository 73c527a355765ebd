// What a page knows of its scene, as JSON: the texts of its passes with the way back to their authors' lines,
// what the channels read, the knobs. `host/` reads it.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"
#include "web/json.hpp"

namespace tidemark::web {

/// Passes that nobody needs are left out, and inputs that no text names. Fails like `make_page`.
Result<Json> scene_data(const scene::Scene& scene);

} // namespace tidemark::web
