// The host's own camera, for scenes that declare iCamera or iOrbit.
#pragma once

#include "base/result.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string_view>

namespace tidemark::render {

/// Circles a target at a distance. World y is up; at azimuth and elevation 0 the camera stands on the
/// positive z axis and looks along negative z. Angles in degrees.
struct OrbitCamera {
    double azimuth = 30;   ///< eastward, wrapped to [0, 360)
    double elevation = 20; ///< clamped to +-89.9: at the pole "up" has no direction
    double distance = 10;  ///< positive
    glm::dvec3 target{0};

    bool operator==(const OrbitCamera&) const = default;

    /// Rotates by a drag of so many pixels in a window `height` pixels high; `height` pixels are half a
    /// circle.
    void turn(double dx, double dy, double height);
    /// Zooms by wheel notches; positive: towards the target.
    void zoom(double notches);
    /// Moves the target by a drag, so that the point under the pointer at the target's distance stays there.
    void pan(double dx, double dy, double height);

    /// Returns camera to world: columns right, up, backwards, position.
    glm::mat4 matrix() const;
};

/// Motion of a camera relative to the host's first view, at which all is exactly 0 and the distance 1. The
/// pan is in first distances along the axes of the first heading: right, up, backwards.
struct OrbitMotion {
    glm::dvec2 turn; ///< azimuth and elevation, radians
    double distance; ///< relative to the first distance
    glm::dvec3 pan;  ///< of the target
};
OrbitMotion motion_of(const OrbitCamera& camera);

/// Reads `azimuth,elevation,distance`, optionally followed by the target `,x,y,z` (default: the origin).
Result<OrbitCamera> parse_camera(std::string_view setting);

} // namespace tidemark::render
