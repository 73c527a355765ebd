// The reference of a scene: its field and the rays of its pixels in double, written anew from the scene's
// mathematics. What the scene's own GLSL makes of them is judged against it.
#pragma once

#include "base/result.hpp"
#include "lab/fields/field.hpp"
#include "lab/fields/lattice.hpp"
#include "scene/knob.hpp"

#include <glm/vec2.hpp>

#include <functional>
#include <span>
#include <string_view>

namespace tidemark::lab {

/// What a frame of a scene depends on.
struct ReferenceInputs {
    std::span<const scene::Knob> knobs{};
    double time = 0;
    glm::dvec2 resolution{640, 360};
    glm::dvec2 mouse{0};                 ///< iMouse.xy
    bool turning_poles = false;          ///< beyond straight up and down the view turns round (TURNING_POLES)
    int octaves = 7;                     ///< of scenes that compile OCTAVES in
    Lattice3 lattice = IntegerLattice{}; ///< of scenes that compile HASH in
};

struct Reference {
    Field field;
    /// The ray through `frag_coord`; the centre of the lower left pixel is (0.5, 0.5).
    std::function<Ray(const glm::dvec2& frag_coord)> ray;
    RayRange range;
};

using MakeReference = Result<Reference> (*)(const ReferenceInputs&);

/// How to make the reference of the scene of that name (Scene::name()); null: it has none.
MakeReference find_reference(std::string_view scene_name);

} // namespace tidemark::lab
