// The reference of a scene of shaders/: its field and the rays of its pixels in double, written anew from the
// scene's mathematics. What the scene's own GLSL makes of them, and what is proved from its text, is held
// against it.
#pragma once

#include "base/error.hpp"
#include "fields/field.hpp"
#include "fields/lattice.hpp"
#include "scene/knob.hpp"

#include <glm/vec2.hpp>

#include <functional>
#include <span>

namespace tidemark::fields {

/// The inputs of a scene's frame.
struct ReferenceInputs {
    std::span<const scene::Knob> knobs{};
    double time = 0;
    glm::dvec2 resolution{640, 360};
    glm::dvec2 mouse{0};                 ///< iMouse.xy
    bool turning_poles = false;          ///< beyond straight up and down the view turns round (TURNING_POLES)
    bool drift_wraps = false;            ///< after 62.83 s, whatever the knob says (DOCUMENT)
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

} // namespace tidemark::fields
