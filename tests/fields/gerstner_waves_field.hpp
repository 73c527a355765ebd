// The reference of shaders/gerstner_waves.glsl: height over four Gerstner waves.
#pragma once

#include "fields/reference.hpp"

namespace tidemark::fields {

/// g(p) = p.y - height of the water that the waves have carried to (p.x, p.z), found by Newton's method to
/// the last bits. With S the sum of the waves' steepness, S < 1,
///     |height| <= sum of the waves' heights
///     |slope of height| <= S / sqrt(1 - S^2)
/// (J = I - sum s sin f d d^T, w = J^-1 sum s cos f d the slope: w = sum s (cos f + sin f d.w) d, so
/// |w| <= S sqrt(1 + |w|^2)).
Result<Reference> gerstner_waves_reference(const ReferenceInputs& inputs);

} // namespace tidemark::fields
