// The fields of gerstner_waves and procedural_ocean against their own bounds and against geometry.
#include "dense_march.hpp"
#include "fields/gerstner_waves_field.hpp"
#include "fields/procedural_ocean_field.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tidemark::fields::wave_fields_test {

struct Waves {
    const char* scene;
    MakeReference make;
};

class WaveFields : public testing::TestWithParam<Waves> {
protected:
    scene::Scene scene() const {
        auto loaded =
            scene::load_scene(std::string(TIDEMARK_SOURCE_DIR "/shaders/") + GetParam().scene + ".glsl");
        EXPECT_TRUE(loaded) << to_string(loaded.error());
        return *std::move(loaded);
    }
    Reference reference(const scene::Scene& scene, double time) const {
        const auto made =
            GetParam().make({.knobs = scene.knobs, .time = time, .resolution = {64, 36}, .octaves = 3});
        EXPECT_TRUE(made) << to_string(made.error());
        return *made;
    }
};

TEST_P(WaveFields, StaysWithinItsBounds) {
    const scene::Scene loaded = scene();
    const Field field = reference(loaded, 10).field;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> wide(-60, 60), depth(field.lowest, field.highest), unit(-1, 1);
    double steepest = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 p{wide(random), depth(random), wide(random)};
        const glm::dvec3 d = glm::normalize(glm::dvec3{unit(random), unit(random), unit(random)});
        const double slope = std::abs(field.value(p + 1e-5 * d) - field.value(p)) / 1e-5;
        steepest = std::max(steepest, slope);
        EXPECT_GE(field.value({p.x, field.highest, p.z}), 0);
        EXPECT_LE(field.value({p.x, field.lowest, p.z}), 0);
    }
    EXPECT_LT(steepest, field.lipschitz);
    EXPECT_GT(steepest, 1.02); // and the sampling meets slopes: more than a plane's 1
}

TEST_P(WaveFields, ClearanceContainsNoZero) {
    const scene::Scene loaded = scene();
    const Field field = reference(loaded, 77).field;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> wide(-60, 60), depth(field.lowest, 4), unit(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p{wide(random), depth(random), wide(random)};
        const glm::dvec3 d = glm::normalize(glm::dvec3{unit(random), unit(random), unit(random)});
        const FieldSample sample = field.sample(p, d);
        ASSERT_EQ(sample.value, field.value(p));
        for (int k = 1; k <= 8 && sample.value >= 0; ++k)
            ASSERT_GT(field.value(p + sample.clearance * k / 8.001 * d), 0) << i << ' ' << k;
    }
}

TEST_P(WaveFields, CertifiedMarchAgreesWithADenseMarch) {
    const scene::Scene loaded = scene();
    const Reference r = reference(loaded, 10);
    int hits = 0;
    for (int y = 1; y < 36; y += 5)
        for (int x = 0; x < 64; x += 7) {
            SCOPED_TRACE(testing::Message() << x << ' ' << y);
            hits += expect_as_dense(r.field, r.ray({x + 0.5, y + 0.5}), {0, 60}, 5e-3);
        }
    EXPECT_GT(hits, 15);
}

INSTANTIATE_TEST_SUITE_P(Scenes, WaveFields,
                         testing::Values(Waves{"gerstner_waves", gerstner_waves_reference},
                                         Waves{"procedural_ocean", procedural_ocean_reference}),
                         [](const auto& waves) { return std::string(waves.param.scene); });

TEST(GerstnerWavesField, NegativeScalesAreRefused) {
    auto loaded = scene::load_scene(TIDEMARK_SOURCE_DIR "/shaders/gerstner_waves.glsl");
    ASSERT_TRUE(loaded);
    ASSERT_TRUE(scene::override_knob(*loaded, "wave_scale=-0.5"));
    EXPECT_FALSE(gerstner_waves_reference({.knobs = loaded->knobs}));
}

/// The document's four waves: where they put the water that rests at `rest`.
glm::dvec3 moved(const glm::dvec2& rest, double time) {
    constexpr double waves[4][4] = {
        {10, 0.3, 1.2, 0}, {5, 0.2, 1.5, 0.785}, {3, 0.1, 2.0, 1.57}, {7, 0.15, 1.0, 2.356}};
    glm::dvec3 place{rest.x, 0, rest.y};
    for (const auto& [length, steepness, pace, angle] : waves) {
        const double k = 2 * M_PI / length;
        const glm::dvec2 d{std::sin(angle), std::cos(angle)};
        const double f = k * (glm::dot(d, rest) - std::sqrt(9.8 / k) * pace * time);
        place += steepness / k * glm::dvec3{d.x * std::cos(f), std::sin(f), d.y * std::cos(f)};
    }
    return place;
}

TEST(GerstnerWavesField, IsZeroOnTheDocumentedSurface) {
    auto loaded = scene::load_scene(TIDEMARK_SOURCE_DIR "/shaders/gerstner_waves.glsl");
    ASSERT_TRUE(loaded);
    for (const double time : {0.0, 3.5, 60.0}) {
        const auto r = gerstner_waves_reference({.knobs = loaded->knobs, .time = time});
        ASSERT_TRUE(r);
        std::mt19937 random(9);
        std::uniform_real_distribution<double> wide(-50, 50);
        for (int i = 0; i < 2000; ++i)
            // binary32 knobs and rates: 1e-7 of the phase.
            EXPECT_NEAR(r->field.value(moved({wide(random), wide(random)}, time)), 0, 3e-6 * (1 + time));
    }
}

TEST(GerstnerWavesField, HasTheBoundsThatAreProvedByHand) {
    auto loaded = scene::load_scene(TIDEMARK_SOURCE_DIR "/shaders/gerstner_waves.glsl");
    ASSERT_TRUE(loaded);
    const auto r = gerstner_waves_reference({.knobs = loaded->knobs});
    EXPECT_NEAR(r->field.lipschitz, 1.5119, 1e-4);
    EXPECT_NEAR(r->field.highest, 0.8515, 1e-4);
}

} // namespace tidemark::fields::wave_fields_test
