#include "fields/gerstner_waves_field.hpp"

#include "fields/knob_reader.hpp"
#include "fields/mouse_camera.hpp"

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tidemark::fields {
namespace {

struct Train {
    glm::dvec2 direction; ///< in x and z
    double wavenumber;    ///< radians a metre
    double steepness;
    double phase;

    double height() const { return steepness / wavenumber; }
    double angle(const glm::dvec2& rest) const { return wavenumber * glm::dot(direction, rest) - phase; }
};

using Trains = std::array<Train, 4>;

constexpr double k_most_steepness = 0.95; // the scene lowers what is steeper

Trains trains_of(KnobReader& knobs, double time) {
    const glm::dvec4 length = knobs.quadruple("wave_length"), steepness = knobs.quadruple("wave_steepness");
    const glm::dvec4 pace = knobs.quadruple("wave_pace"), direction = knobs.quadruple("wave_direction");
    const double scale = knobs.not_negative("wave_scale") / 0.5;
    // Rates are binary32 by definition: over a long time a last bit is whole waves.
    const float speed = float(knobs.number("wave_speed")) / 1.2F;

    double total = 0;
    for (int i = 0; i < 4; ++i)
        total += std::abs(steepness[i]) * scale;
    Trains trains;
    for (int i = 0; i < 4; ++i) {
        const float wavenumber = 6.283185307F / float(std::max(length[i], 0.01));
        const float rate = std::sqrt(9.8F * wavenumber) * float(pace[i]) * speed;
        trains[size_t(i)] = {{std::sin(direction[i]), std::cos(direction[i])},
                             wavenumber,
                             std::abs(steepness[i]) * scale * std::min(1.0, k_most_steepness / total),
                             std::fmod(double(rate) * time, 2 * std::numbers::pi)};
    }
    return trains;
}

/// Returns the rest position of the water that is now at `place`. The Jacobian's eigenvalues are at least 1 -
/// 0.95, and Newton's method converges from everywhere: six steps leave 1e-14 at the defaults, steeper waves
/// take some more.
glm::dvec2 unmoved(const Trains& trains, const glm::dvec2& place) {
    glm::dvec2 rest = place;
    for (int i = 0; i < 30; ++i) {
        glm::dvec2 off = rest - place;
        glm::dmat2 jacobian(1.0);
        for (const Train& train : trains) {
            const double angle = train.angle(rest);
            off += train.height() * std::cos(angle) * train.direction;
            jacobian -=
                train.steepness * std::sin(angle) * glm::outerProduct(train.direction, train.direction);
        }
        const glm::dvec2 step = glm::inverse(jacobian) * off;
        rest -= step;
        if (glm::length(step) < 1e-14 * (1 + glm::length(rest)))
            break;
    }
    return rest;
}

double height_at(const Trains& trains, const glm::dvec2& place) {
    const glm::dvec2 rest = unmoved(trains, place);
    double height = 0;
    for (const Train& train : trains)
        height += train.height() * std::sin(train.angle(rest));
    return height;
}

Field field_of(const Trains& trains) {
    double highest = 0, steepness = 0;
    for (const Train& train : trains) {
        highest += train.height();
        steepness += train.steepness;
    }
    const double slope = steepness / std::sqrt(1 - steepness * steepness);
    const auto value = [trains](const glm::dvec3& p) { return p.y - height_at(trains, {p.x, p.z}); };
    const auto sample = [value, slope](const glm::dvec3& p, const glm::dvec3& d) {
        const double height = value(p);
        return FieldSample{height, height / (std::abs(d.y) + slope * std::hypot(d.x, d.z))};
    };
    return {sample, value, -highest, highest, std::hypot(1.0, slope)};
}

} // namespace

Result<Reference> gerstner_waves_reference(const ReferenceInputs& inputs) {
    KnobReader knobs(inputs.knobs);
    const Trains trains = trains_of(knobs, inputs.time);
    const RayRange range{0, knobs.number("far_distance")};
    auto ray = mouse_camera(knobs, inputs);
    if (knobs.error())
        return fail(*knobs.error());
    return Reference{field_of(trains), std::move(ray), range};
}

} // namespace tidemark::fields
