// The reference of a scene: its field and the rays of its pixels in double, written anew from the scene's
// mathematics. What the scene's own GLSL makes of them is judged against it. It belongs to a text, not to a
// name: after any edit of the field there is none.
#pragma once

#include "base/result.hpp"
#include "lab/fields/field.hpp"
#include "lab/fields/lattice.hpp"
#include "scene/scene.hpp"

#include <glm/vec2.hpp>

#include <functional>
#include <span>
#include <string>

namespace tidemark::lab {

/// What a frame of a scene depends on.
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

/// A reference that was written for a text, and how that text has it.
struct FoundReference {
    MakeReference make = nullptr;
    std::string field_hash{}; ///< of the text, with the definitions that may vary at fixed values
    bool sine_lattice = false;
    bool turning_poles = false;
    bool drift_wraps = false;
    int octaves = 7;
};

/// By the text of its field (lab/fields/field_text.hpp), whatever the scene is called. Fails
/// (ErrorCode::load) with the reason why no reference applies.
Result<FoundReference> find_reference(const scene::Scene& scene);

} // namespace tidemark::lab
