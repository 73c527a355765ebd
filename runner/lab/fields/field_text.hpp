// What decides where a scene's rays end, but for the solver, as a hash of its text: two scenes of one hash
// have one field. Text in, digits out; draws nothing.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"

#include <string>

namespace tidemark::lab {

/// SHA-256 over the words, macros expanded, of `mainHit` and of all that it reaches in Common and Image:
/// functions, structures, constants, and the types of knobs, not their values. `march`, which looks for the
/// surface (shaders/lib/march.glsl), is left out, with what only it reaches; that it asks the field with
/// `march_sample` is not. Comments and blanks change nothing, any other edit does. Fails (ErrorCode::load)
/// without mainHit, and where the text cannot be followed or asks for its driver.
Result<std::string> field_hash(const scene::Scene& scene);

} // namespace tidemark::lab
