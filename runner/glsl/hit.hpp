// `mainHit`, the entry point with which a scene reports the hits of its rays to studies and checks:
//
//     void mainHit(out vec4 hit, in vec2 fragCoord)
//
// hit.x is the distance along the ray, or -1 for a miss; hit.y counts evaluations of the field; hit.z is the
// field's last value; hit.w is the sum of the flags below. TIDEMARK_HIT is defined as 1 in this pass.
#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string_view>

namespace tidemark::glsl {

enum HitFlag {
    k_hit_exhausted = 1,      ///< the maximum number of steps was reached
    k_hit_negative = 2,       ///< the field was negative at a sample after the first: a step was too long
    k_hit_started_inside = 4, ///< the field was negative at the first sample
};

inline constexpr std::string_view k_hit_macro = "TIDEMARK_HIT";

/// Returns the scene with mainHit as the entry point of its Image pass; nothing if the text does not mention
/// it.
std::optional<scene::Scene> hit_scene(const scene::Scene& scene);

} // namespace tidemark::glsl
