#include "fields/mouse_camera.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tidemark::fields {

std::function<Ray(const glm::dvec2&)> mouse_camera(KnobReader& knobs, const ReferenceInputs& inputs) {
    const glm::dvec3 position = knobs.triple("camera_position");
    const double focal_length = knobs.number("focal_length");
    const bool at_rest = !inputs.turning_poles && inputs.mouse == glm::dvec2(0);
    const glm::dvec2 turn = at_rest ? knobs.pair("default_turn") : inputs.mouse / inputs.resolution;
    const glm::dvec2 turned = glm::clamp(turn, 0.0, 1.0) - 0.5;
    const double yaw = knobs.number("yaw_range") * turned.x;
    const double whole_pitch = knobs.number("pitch_range") * turned.y;
    constexpr double k_pole = std::numbers::pi / 2;
    const double pitch = inputs.turning_poles ? whole_pitch : std::clamp(whole_pitch, -k_pole, k_pole);

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

} // namespace tidemark::fields
