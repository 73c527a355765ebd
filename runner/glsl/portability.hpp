// `tidemark check --portable`: what ShaderToy's own compiler (GLSL ES 3.00, in a browser) will refuse
// although a desktop driver takes it. Reads the texts alone and speaks only when it is sure; a compiler for
// that language (PassReading::site_source) finds the rest.
#pragma once

#include "glsl/pass_reading.hpp"
#include "scene/scene.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// One warning for each place, in the order of the scene's passes (Common first), with what to write instead.
std::vector<Diagnostic> portability_lint(const scene::Scene& scene);

/// Whether a driver's message is about what the site takes: a parameter without a name, or a function of
/// GLSL's own that the text defines again.
bool is_taken_by_the_site(const PassReading& reading, std::string_view message);

} // namespace tidemark::glsl
