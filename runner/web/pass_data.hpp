// A pass as JSON, in the form in which the page compiles it.
#pragma once

#include "scene/scene.hpp"
#include "web/json.hpp"

#include <vector>

namespace tidemark::web {

/// Returns `name`, `kind`, `source` (GLSL ES 3.00: the author's text and the host's around it), `lines`
/// (which lines of the source come from which file), `discards`, and `foreign` (it may use other hosts'
/// uniforms).
Json pass_data(const scene::Scene& scene, const scene::Pass& pass);

/// Returns the channels that the text may read, ascending.
std::vector<size_t> channels_named(const scene::Scene& scene, const scene::Pass& pass);

} // namespace tidemark::web
