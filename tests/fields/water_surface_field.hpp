// The reference of shaders/water_surface.glsl: folded value noise under a bobbing plane, with a bound on its
// slope derived from the knobs.
#pragma once

#include "fields/reference.hpp"

namespace tidemark::fields {

/// g(p) = y + crests(p) + bob(x), positive above the water: the scene's field before its step_scale.
///
/// crests is a sum of octaves h_k |sin(n - 1/2)|, n value noise on cells of 1 / f_k; so
///     0 <= octave k <= h_k sin(1/2)            the surface lies between -(all of that) - bob and +bob
///     |slope of octave k| <= h_k f_k 3/2       (k_value_noise_slope; |sin|' <= 1; the turn keeps lengths)
///     |slope of bob| <= height frequency |d.x| along d
/// and every partial sum of octaves is a lower bound of g: the clearance is the best of them all.
Result<Reference> water_surface_reference(const ReferenceInputs& inputs);

} // namespace tidemark::fields
