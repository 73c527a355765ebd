// A scene as JSON for its page: the passes' texts with the authors' lines, the channels' inputs, the knobs.
// `host/` reads it.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"
#include "web/json.hpp"

namespace tidemark::web {

/// Leaves out passes that are not needed and inputs that no text names. Fails like `make_page`.
Result<Json> scene_data(const scene::Scene& scene);

} // namespace tidemark::web
