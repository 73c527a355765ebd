#include "lab/mouse_camera.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>

namespace tidemark::lab {

std::function<Ray(const glm::dvec2&)> mouse_camera(KnobReader& knobs, const ReferenceInputs& inputs,
                                                   const std::optional<glm::dvec2>& untouched) {
    const glm::dvec3 position = knobs.triple("camera_position");
    const double focal_length = knobs.number("focal_length");
    const bool at_rest = untouched && inputs.mouse == glm::dvec2(0);
    const glm::dvec2 turn = at_rest ? *untouched : inputs.mouse / inputs.resolution;
    const glm::dvec2 turned = glm::clamp(turn, 0.0, 1.0) - 0.5;
    const double yaw = knobs.number("yaw_range") * turned.x;
    const double pitch = knobs.number("pitch_range") * turned.y;

    const double level = std::cos(pitch);
    const glm::dvec3 forward{std::sin(yaw) * level, std::sin(pitch), std::cos(yaw) * level};
    const glm::dvec3 right = (level < 0 ? -1.0 : 1.0) * glm::dvec3{-std::cos(yaw), 0, std::sin(yaw)};
    const glm::dmat3 axes(right, glm::cross(right, forward), forward);
    const glm::dvec2 resolution = inputs.resolution;
    return [=](const glm::dvec2& frag_coord) {
        const glm::dvec2 uv = (frag_coord - 0.5 * resolution) / resolution.y;
        return Ray{position, axes * glm::normalize(glm::dvec3(uv, focal_length))};
    };
}

} // namespace tidemark::lab
