// A scalar field along rays, in double: what a reference marches. Its zero is the surface, it is positive
// where the camera usually stands. Nothing of GL, of pixels or of time: a field is a frame's field.
#pragma once

#include <glm/vec3.hpp>

#include <functional>

namespace tidemark::fields {

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction; ///< of length 1

    glm::dvec3 at(double t) const { return origin + t * direction; }
};

struct FieldSample {
    double value;     ///< of the field; where it is positive a lower bound of it may stand for it
    double clearance; ///< no zero lies nearer than this ahead on the ray: proved, not guessed
};

struct Field {
    /// The field at `position` and how far it is safe to go from there in `direction` (of length 1).
    std::function<FieldSample(const glm::dvec3& position, const glm::dvec3& direction)> sample;
    /// The field's value alone, whole.
    std::function<double(const glm::dvec3& position)> value;
    /// All zeros have lowest <= y <= highest; the field is positive above and negative below.
    double lowest;
    double highest;
    /// |value(a) - value(b)| <= lipschitz |a - b|.
    double lipschitz;
};

/// The part of a ray in which a scene looks for its surface, world units.
struct RayRange {
    double near;
    double far;
};

} // namespace tidemark::fields
