#include "fields/procedural_ocean_field.hpp"

#include "fields/knob_reader.hpp"
#include "fields/mouse_camera.hpp"
#include "fields/value_noise.hpp"

#include <glm/mat2x2.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tidemark::fields {
namespace {

struct Octave {
    double height; ///< of one direction
    double choppiness;
    glm::dmat2 lattice; ///< from world x and z to the octave's cells
    double offset;      ///< in cells, of the octave that runs forwards; backwards: its negative
    double drift;
    double slope; ///< bound of both directions'
};

using Octaves = std::vector<Octave>;

Octaves octaves_of(KnobReader& knobs, const ReferenceInputs& inputs) {
    const double scale = knobs.not_negative("sea_scale");
    double height = knobs.not_negative("wave_height") / scale;
    double choppiness = knobs.not_negative("wave_choppiness");
    double frequency = knobs.not_negative("wave_frequency");
    // Cells a second are binary32 by definition: over a long time a last bit is whole cells.
    float rate = float(frequency) * float(knobs.number("wave_speed"));
    const glm::dmat2 turn(1.6, -1.2, 1.2, 1.6);
    glm::dmat2 lattice(0.75 * scale, 0, 0, scale);
    double stretch = scale;

    Octaves octaves;
    for (int k = 0; k < std::clamp(inputs.octaves, 1, 8); ++k) {
        const double ridge_slope = 0.68 + 0.3 * choppiness;
        octaves.push_back({height, choppiness, lattice * frequency, frequency, double(rate) * inputs.time,
                           2 * height * stretch * frequency * (1 + 3 * std::numbers::sqrt2) * ridge_slope});
        lattice = turn * lattice;
        stretch *= 2;
        frequency *= 1.9;
        rate *= 1.9F;
        height *= 0.22;
        choppiness += 0.2 * (1 - choppiness);
    }
    return octaves;
}

double ridges(const glm::dvec2& at, double choppiness) {
    const auto profile = [](double x) {
        const double s = std::abs(std::sin(x)), c = std::abs(std::cos(x));
        return (1 - s) * (s + c);
    };
    const double both = std::max(profile(at.x) * profile(at.y), 0.0);
    return std::pow(std::max(1 - std::pow(both, 0.65), 0.0), choppiness);
}

double octave_at(const Octave& octave, const glm::dvec2& place) {
    double sum = 0;
    for (const double side : {1.0, -1.0}) {
        const glm::dvec2 at = octave.lattice * place + side * (octave.offset + octave.drift);
        sum += ridges(at + (2 * value_noise(IntegerLattice{}, at) - 1), octave.choppiness);
    }
    return octave.height * sum;
}

double value_at(const Octaves& octaves, const glm::dvec3& p) {
    double value = p.y;
    for (const Octave& octave : octaves)
        value -= octave_at(octave, {p.x, p.z});
    return value;
}

FieldSample sample_at(const Octaves& octaves, const glm::dvec3& p, const glm::dvec3& d) {
    const double level = std::hypot(d.x, d.z);
    double slope = std::abs(d.y), rest = 0;
    for (const Octave& octave : octaves)
        rest += 2 * octave.height;
    FieldSample sample{p.y, (p.y - rest) / slope};
    for (const Octave& octave : octaves) {
        sample.value -= octave_at(octave, {p.x, p.z});
        rest -= 2 * octave.height;
        slope += level * octave.slope;
        sample.clearance = std::max(sample.clearance, (sample.value - rest) / slope);
    }
    return sample;
}

Field field_of(const Octaves& octaves) {
    double highest = 0, slope = 0;
    for (const Octave& octave : octaves) {
        highest += 2 * octave.height;
        slope += octave.slope;
    }
    return {[octaves](const glm::dvec3& p, const glm::dvec3& d) { return sample_at(octaves, p, d); },
            [octaves](const glm::dvec3& p) { return value_at(octaves, p); }, 0, highest,
            std::hypot(1.0, slope)};
}

} // namespace

Result<Reference> procedural_ocean_reference(const ReferenceInputs& inputs) {
    if (!std::holds_alternative<IntegerLattice>(inputs.lattice))
        return fail(ErrorCode::usage, "the reference of procedural_ocean knows its integer hash alone: leave "
                                      "INTEGER_HASH at 1");
    KnobReader knobs(inputs.knobs);
    const Octaves octaves = octaves_of(knobs, inputs);
    const RayRange range{0, knobs.number("far_distance")};
    auto ray = mouse_camera(knobs, inputs);
    if (knobs.error())
        return fail(*knobs.error());
    return Reference{field_of(octaves), std::move(ray), range};
}

} // namespace tidemark::fields
