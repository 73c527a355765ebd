// `tidemark check --portable`: finds code that a desktop driver accepts but ShaderToy's compiler (GLSL ES
// 3.00, in a browser) will reject. Reads the texts only and reports only certain problems; an ES compiler
// finds the rest (PassReading::site_source).
#pragma once

#include "scene/scene.hpp"
#include "shader/pass_reading.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Returns one warning for each place, with a replacement, in the order of the scene's passes (Common first).
std::vector<Diagnostic> portability_lint(const scene::Scene& scene);

/// Returns whether a driver's message is about something that ShaderToy accepts: an unnamed parameter, or a
/// built-in function that the text redefines.
bool is_taken_by_the_site(const PassReading& reading, std::string_view message);

} // namespace tidemark::glsl
