#include "fields/water_surface_field.hpp"

#include "fields/knob_reader.hpp"
#include "fields/mouse_camera.hpp"
#include "fields/value_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace tidemark::fields {
namespace {

constexpr int k_most_octaves = 12;

struct Octave {
    double height;       ///< h_k: before folding
    double frequency;    ///< f_k: cells a unit
    double drift;        ///< in cells along z
    double cosine, sine; ///< of the turn of x and y
    double slope;        ///< bound of the octave's own
};

struct Sea {
    std::array<Octave, k_most_octaves> octaves;
    int count;
    double bob_height, bob_phase, bob_frequency;
    Lattice3 lattice;
};

/// The seconds of the drift: wrapped when there is a period to wrap at.
double drift_seconds(double time, double period) {
    return period > 0 ? time - period * std::floor(time / period) : time;
}

Sea sea_of(KnobReader& knobs, const ReferenceInputs& inputs) {
    Sea sea{};
    sea.count = std::clamp(inputs.octaves, 0, k_most_octaves);
    sea.lattice = inputs.lattice;
    sea.bob_height = knobs.number("bob_height");
    sea.bob_phase = knobs.number("bob_rate") * inputs.time;
    sea.bob_frequency = knobs.number("bob_frequency");

    const double gain = knobs.not_negative("wave_gain"), lacunarity = knobs.not_negative("wave_lacunarity");
    const double turn = knobs.number("turn_angle") * std::sin(knobs.number("turn_rate") * inputs.time);
    // The scene lets a sea of sines start again even where its knob says never.
    const double period = knobs.number("drift_period");
    const bool sines = std::holds_alternative<SineLattice>(inputs.lattice);
    const bool wraps = inputs.drift_wraps || (sines && period <= 0);
    const double seconds = drift_seconds(inputs.time, wraps ? 62.83F : period);
    double height = double(3.14F) * knobs.not_negative("wave_height");
    double frequency = knobs.not_negative("wave_scale");
    // Cells a second are binary32 by definition: over a long time a last bit is whole cells.
    float drift_rate = float(frequency) * float(knobs.number("wave_speed"));
    for (int k = 0; k < sea.count; ++k) {
        height *= gain;
        sea.octaves[size_t(k)] = {height,
                                  frequency,
                                  double(drift_rate) * seconds,
                                  std::cos(k * turn),
                                  std::sin(k * turn),
                                  height * frequency * k_value_noise_slope};
        frequency *= lacunarity;
        drift_rate *= float(lacunarity);
    }
    return sea;
}

double bob(const Sea& sea, double x) {
    return sea.bob_height * std::sin(sea.bob_phase + sea.bob_frequency * x);
}

template <class Lattice>
double octave_at(const Octave& octave, const Lattice& lattice, const glm::dvec3& p) {
    const double f = octave.frequency;
    const glm::dvec3 q{f * (octave.cosine * p.x + octave.sine * p.y),
                       f * (octave.cosine * p.y - octave.sine * p.x), f * p.z - octave.drift};
    return octave.height * std::sin(std::abs(value_noise(lattice, q) - 0.5));
}

double value_at(const Sea& sea, const glm::dvec3& p) {
    return std::visit(
        [&](const auto& lattice) {
            double value = p.y + bob(sea, p.x);
            for (int k = 0; k < sea.count; ++k)
                value += octave_at(sea.octaves[size_t(k)], lattice, p);
            return value;
        },
        sea.lattice);
}

/// Octave by octave, the coarsest first, until the finer ones cannot lengthen the step any more.
FieldSample sample_at(const Sea& sea, const glm::dvec3& p, const glm::dvec3& direction) {
    const double base_slope =
        std::abs(direction.y) + std::abs(sea.bob_height * sea.bob_frequency * direction.x);
    return std::visit(
        [&](const auto& lattice) {
            FieldSample sample{p.y + bob(sea, p.x), 0};
            double slope = base_slope;
            double most = sample.value; // what the whole sum can still reach
            for (int k = 0; k < sea.count; ++k)
                most += sea.octaves[size_t(k)].height * std::sin(0.5);
            sample.clearance = sample.value / slope;
            for (int k = 0; k < sea.count; ++k) {
                const Octave& octave = sea.octaves[size_t(k)];
                if (sample.value > 0 && most / (slope + octave.slope) <= sample.clearance)
                    break;
                const double value = octave_at(octave, lattice, p);
                sample.value += value;
                most += value - octave.height * std::sin(0.5);
                slope += octave.slope;
                if (!(sample.value / slope <= sample.clearance)) // NaN too
                    sample.clearance = sample.value / slope;
            }
            return sample;
        },
        sea.lattice);
}

Field field_of(Sea sea) {
    double fold = 0, slope = std::abs(sea.bob_height * sea.bob_frequency) + 1;
    for (int k = 0; k < sea.count; ++k) {
        fold += sea.octaves[size_t(k)].height * std::sin(0.5);
        slope += sea.octaves[size_t(k)].slope;
    }
    const double bob_height = std::abs(sea.bob_height);
    const auto shared = std::make_shared<const Sea>(std::move(sea));
    return {[shared](const glm::dvec3& p, const glm::dvec3& d) { return sample_at(*shared, p, d); },
            [shared](const glm::dvec3& p) { return value_at(*shared, p); }, -fold - bob_height, bob_height,
            slope};
}

} // namespace

Result<Reference> water_surface_reference(const ReferenceInputs& inputs) {
    KnobReader knobs(inputs.knobs);
    Sea sea = sea_of(knobs, inputs);
    const RayRange range{knobs.number("near_distance"), knobs.number("far_distance")};
    auto ray = mouse_camera(knobs, inputs);
    if (knobs.error())
        return fail(*knobs.error());
    return Reference{field_of(std::move(sea)), std::move(ray), range};
}

} // namespace tidemark::fields
