// `--define NAME=VALUE`: replaces the body of the scene's `#define NAME` or the value of its `const … NAME`.
#pragma once

#include "scene/scene.hpp"

#include <string_view>

namespace tidemark::glsl {

/// Rewrites every definition of NAME in every pass. The error (ErrorCode::usage) names the nearest
/// definition there is. Macros with parameters and values over several lines are left alone.
Result<void> override_definition(scene::Scene& scene, std::string_view setting);

} // namespace tidemark::glsl
