// The reference of shaders/procedural_ocean.glsl: height over ridged octaves that run against each other.
#pragma once

#include "fields/reference.hpp"

namespace tidemark::fields {

/// g(p) = p.y - the sum of the coarse octaves at (p.x, p.z). Octave k, run both ways, has
///     0 <= height <= 2 a_k
///     |slope| <= 2 a_k f_k (1 + 3 sqrt 2) G(c_k),  G(c) = 0.68 + 0.3 c for 1 <= c <= 10,
/// f_k its cells a unit, c_k its choppiness: ridges have a slope of at most G, and the noise that moves both
/// their coordinates has one of 3. Sums of the coarsest octaves, less what the finer ones can add, are lower
/// bounds. `inputs.octaves` are those of the shape (MARCH_OCTAVES); the sine lattice is not for this scene.
Result<Reference> procedural_ocean_reference(const ReferenceInputs& inputs);

} // namespace tidemark::fields
