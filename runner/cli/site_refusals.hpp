// Errors of a GLSL ES 3.00 compiler in a scene's texts as ShaderToy's site would compile them.
#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace tidemark::cli {

/// Adds compile errors to those `found` by reading (glsl/portability.hpp). Each place is reported once,
/// including places of Common, which precedes every pass, and places in `found` before. A context must be
/// current.
void add_site_refusals(const scene::Scene& scene, std::vector<Diagnostic>& found);

} // namespace tidemark::cli
