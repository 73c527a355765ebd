#include "render/orbit_camera.hpp"

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace tidemark::render {
namespace {

constexpr double k_highest = 89.9;
constexpr double k_nearest = 1e-3;
constexpr double k_farthest = 1e6;
constexpr double k_zoom_a_notch = 0.9;

glm::dmat4 camera_to_world(const OrbitCamera& camera) {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1), camera.target);
    matrix = glm::rotate(matrix, glm::radians(camera.azimuth), glm::dvec3(0, 1, 0));
    matrix = glm::rotate(matrix, glm::radians(-camera.elevation), glm::dvec3(1, 0, 0));
    return glm::translate(matrix, glm::dvec3(0, 0, camera.distance));
}

double wrapped(double degrees) {
    const double turned = std::fmod(degrees, 360.0);
    const double positive = turned < 0 ? turned + 360 : turned;
    return positive < 360 ? positive : 0; // a tiny negative angle rounds to 360
}

/// Reads comma-separated numbers within the range of a float; returns nothing for any other text.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    do {
        const auto [rest, error] = std::from_chars(at, end, numbers.emplace_back());
        if (error != std::errc{} || !(std::abs(numbers.back()) <= std::numeric_limits<float>::max()))
            return std::nullopt;
        at = rest;
    } while (at != end && *at == ',' && ++at);
    return at == end ? std::optional(std::move(numbers)) : std::nullopt;
}

} // namespace

void OrbitCamera::turn(double dx, double dy, double height) {
    azimuth = wrapped(azimuth - dx / height * 180);
    elevation = std::clamp(elevation - dy / height * 180, -k_highest, k_highest);
}

void OrbitCamera::zoom(double notches) {
    distance = std::clamp(distance * std::pow(k_zoom_a_notch, notches), k_nearest, k_farthest);
}

void OrbitCamera::pan(double dx, double dy, double height) {
    const glm::dmat4 frame = camera_to_world(*this);
    const double scale = distance / height;
    target -= (glm::dvec3(frame[0]) * dx + glm::dvec3(frame[1]) * dy) * scale;
}

glm::mat4 OrbitCamera::matrix() const {
    return glm::mat4(camera_to_world(*this));
}

OrbitMotion motion_of(const OrbitCamera& camera) {
    const OrbitCamera first;
    const glm::dvec2 degrees{std::remainder(camera.azimuth - first.azimuth, 360),
                             camera.elevation - first.elevation};
    const double heading = glm::radians(first.azimuth);
    const glm::dvec3 right{std::cos(heading), 0, -std::sin(heading)};
    const glm::dvec3 backwards{std::sin(heading), 0, std::cos(heading)};
    const glm::dvec3 moved = (camera.target - first.target) / first.distance;
    return {glm::radians(degrees),
            camera.distance / first.distance,
            {dot(moved, right), moved.y, dot(moved, backwards)}};
}

Result<OrbitCamera> parse_camera(std::string_view setting) {
    const auto numbers = numbers_of(setting);
    if (!numbers || (numbers->size() != 3 && numbers->size() != 6) || (*numbers)[2] < k_nearest ||
        (*numbers)[2] > k_farthest)
        return fail(
            ErrorCode::usage,
            fmt::format("--camera {}: give azimuth,elevation,distance as in 30,20,10 (degrees, degrees, "
                        "a distance above 0), and behind them x,y,z where it is panned to",
                        setting));
    OrbitCamera camera;
    camera.azimuth = wrapped((*numbers)[0]);
    camera.elevation = std::clamp((*numbers)[1], -k_highest, k_highest);
    camera.distance = (*numbers)[2];
    if (numbers->size() == 6)
        camera.target = {(*numbers)[3], (*numbers)[4], (*numbers)[5]};
    return camera;
}

} // namespace tidemark::render
