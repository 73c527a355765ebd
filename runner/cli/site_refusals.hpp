// What a compiler for GLSL ES 3.00 says of a scene's texts as ShaderToy's site would compile them.
#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace tidemark::cli {

/// Adds to what was `found` by reading (glsl/portability.hpp). One place is reported once: of Common, that
/// stands in front of every pass, and of what was found before. A context must be current.
void add_site_refusals(const scene::Scene& scene, std::vector<Diagnostic>& found);

} // namespace tidemark::cli
