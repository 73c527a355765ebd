// `mainHit`, the entry point by which a scene tells what its rays met, for studies and checks:
//
//     void mainHit(out vec4 hit, in vec2 fragCoord)
//
// hit.x is the distance along the ray, or -1 for a miss; hit.y counts evaluations of the field; hit.z is the
// field's last value; hit.w adds up the flags below. Where it is compiled, TIDEMARK_HIT is defined as 1.
#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string_view>

namespace tidemark::glsl {

enum HitFlag {
    k_hit_exhausted = 1,      ///< the budget of steps ran out
    k_hit_negative = 2,       ///< the field was negative at a sample behind the first: a step was too long
    k_hit_started_inside = 4, ///< the field was negative at the first sample
};

inline constexpr std::string_view k_hit_macro = "TIDEMARK_HIT";

/// The scene with its Image pass asked for mainHit; nothing where the text has none.
std::optional<scene::Scene> hit_scene(const scene::Scene& scene);

} // namespace tidemark::glsl
