// Value noise in double: random numbers on a lattice, smoothly interpolated with 3 s^2 - 2 s^3. The twin of
// shaders/lib/noise.glsl.
#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace tidemark::fields {

/// |gradient| of value noise over lattice values 0..1: 3/2, reached in the middle of a face of the lattice
/// whose sides are 0 and 1 (the norm is convex in the corners' values, so its largest value has corners of 0
/// and 1; searched over all patterns, docs in shaders/lib/noise.glsl).
inline constexpr double k_value_noise_slope = 1.5;

template <class T>
T fade(const T& s) {
    return s * s * (3.0 - 2.0 * s);
}

/// 0..1 over a lattice of values 0..1.
template <class Lattice>
double value_noise(const Lattice& lattice, const glm::dvec3& position) {
    const glm::dvec3 cell = glm::floor(position);
    const glm::dvec3 part = fade(position - cell);
    const auto x = int64_t(cell.x), y = int64_t(cell.y), z = int64_t(cell.z);
    const auto edge = [&](int64_t j, int64_t k) {
        return glm::mix(lattice(x, y + j, z + k), lattice(x + 1, y + j, z + k), part.x);
    };
    const auto face = [&](int64_t k) { return glm::mix(edge(0, k), edge(1, k), part.y); };
    return glm::mix(face(0), face(1), part.z);
}

template <class Lattice>
double value_noise(const Lattice& lattice, const glm::dvec2& position) {
    const glm::dvec2 cell = glm::floor(position);
    const glm::dvec2 part = fade(position - cell);
    const auto x = int64_t(cell.x), y = int64_t(cell.y);
    const auto edge = [&](int64_t j) { return glm::mix(lattice(x, y + j), lattice(x + 1, y + j), part.x); };
    return glm::mix(edge(0), edge(1), part.y);
}

} // namespace tidemark::fields
