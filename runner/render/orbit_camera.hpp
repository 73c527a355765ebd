// The host's own camera, for scenes that declare `uniform mat4 iCamera`.
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

    /// A drag by so many pixels in a window `height` pixels high: once across turns by half a circle.
    void turn(double dx, double dy, double height);
    /// A wheel by so many notches, towards the target when positive.
    void zoom(double notches);
    /// A drag that keeps the point under the pointer there, at the target's distance.
    void pan(double dx, double dy, double height);

    /// Camera to world: columns right, up, backwards, position.
    glm::mat4 matrix() const;
};

/// How a camera was moved from where the host's begins: there all is 0, and the distance 1, exactly. The pan
/// is in first distances and the axes of the first heading: right, up, backwards.
struct OrbitMotion {
    glm::dvec2 turn; ///< azimuth and elevation, radians
    double distance; ///< in parts of the first
    glm::dvec3 pan;  ///< of the target
};
OrbitMotion motion_of(const OrbitCamera& camera);

/// Reads `azimuth,elevation,distance`, and behind it the target `x,y,z` where that is not the origin.
Result<OrbitCamera> parse_camera(std::string_view setting);

} // namespace tidemark::render
