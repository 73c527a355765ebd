// A pass as the page compiles it.
#pragma once

#include "scene/scene.hpp"
#include "web/json.hpp"

#include <vector>

namespace tidemark::web {

/// `name`, `kind`, `source` (GLSL ES 3.00: the author's text as WebGL has it, ours around it), `lines` (of
/// the source from which on a file has which lines) and whether it `discards`.
Json pass_data(const scene::Scene& scene, const scene::Pass& pass);

/// The channels that the text may look at, ascending.
std::vector<size_t> channels_named(const scene::Scene& scene, const scene::Pass& pass);

} // namespace tidemark::web
