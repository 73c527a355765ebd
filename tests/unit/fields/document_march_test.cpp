// The document's own march of the water surface, in double, on the lattice that libm's sine makes. An
// independent program computed the same picture (its own field, its own march with a proof, 320x180, iTime
// 10, mouse at (.75, .4)): these are its figures. What a device shows differs from them by its lattice alone.
#include "fields/certified_march.hpp"
#include "fields/water_surface_field.hpp"
#include "lab/hits.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tidemark::fields::document_march_test {

constexpr Extent k_extent{320, 180};

/// `fract(sin(n) * 43785.5)` in floats, with libm's sine.
SineLattice libm_lattice() {
    constexpr int64_t k_last = 150'000;
    SineLattice lattice{-k_last, {}};
    for (int64_t n = -k_last; n <= k_last; ++n) {
        const float product = std::sin(float(n)) * 43785.5F;
        lattice.values.push_back(product - std::floor(product));
    }
    return lattice;
}

Reference typical_view() {
    auto scene = scene::load_scene(TIDEMARK_SOURCE_DIR "/shaders/water_surface.glsl");
    EXPECT_TRUE(scene) << to_string(scene.error());
    ReferenceInputs inputs;
    inputs.knobs = scene->knobs;
    inputs.time = 10;
    inputs.resolution = {k_extent.width, k_extent.height};
    inputs.mouse = {240, 72};
    inputs.lattice = libm_lattice();
    auto made = water_surface_reference(inputs);
    EXPECT_TRUE(made) << to_string(made.error());
    return *std::move(made);
}

struct Found {
    double distance;
    int samples;
};

/// Steps of half the height, as the document has them.
Found sphere_trace(const Reference& reference, const Ray& ray, int most_steps, double touching) {
    double t = reference.range.near;
    int samples = 0;
    while (samples < most_steps && t <= reference.range.far) {
        const double value = 0.5 * reference.field.value(ray.at(t));
        ++samples;
        if (value < touching)
            return {t, samples};
        t += value;
    }
    return {t <= reference.range.far ? t : -1, samples};
}

/// The same for every pixel of the view.
template <class March>
lab::Hits hits_of_view(const Reference& reference, March march) {
    lab::Hits hits;
    for (int y = 0; y < k_extent.height; ++y)
        for (int x = 0; x < k_extent.width; ++x) {
            const auto [distance, samples] = march(reference.ray({x + 0.5, y + 0.5}));
            hits.distance.push_back(distance);
            hits.evaluations.push_back(float(samples));
        }
    hits.flags.assign(hits.size(), 0);
    return hits;
}

TEST(DocumentMarch, ErrorsEqualThoseOfAnIndependentProgram) {
    const Reference reference = typical_view();
    const lab::Hits truth = hits_of_view(reference, [&](const Ray& ray) {
        const CertifiedHit hit = certified_march(reference.field, ray, reference.range);
        return Found{hit.distance, hit.samples};
    });
    const std::vector<double> footprint(truth.size(), 1.0 / k_extent.height);
    const auto errors = [&](int most_steps, double touching) {
        return lab::hit_errors(
            truth,
            hits_of_view(reference,
                         [&](const Ray& ray) { return sphere_trace(reference, ray, most_steps, touching); }),
            footprint);
    };
    const lab::HitErrors usual = errors(128, 1e-4);
    EXPECT_NEAR(usual.rms, 0.108, 0.0005);
    EXPECT_NEAR(usual.wrong_tenth, 0.196, 0.001);
    EXPECT_NEAR(usual.evaluations, 35.7, 0.2);

    const lab::HitErrors strict = errors(1024, 1e-5);
    EXPECT_NEAR(strict.rms, 0.000311, 0.000001);
    EXPECT_EQ(strict.wrong_tenth, 0);
    EXPECT_EQ(strict.rms_right, strict.rms);
    EXPECT_NEAR(strict.evaluations / usual.evaluations, 41.0 / 35.7, 0.005);
}

} // namespace tidemark::fields::document_march_test
