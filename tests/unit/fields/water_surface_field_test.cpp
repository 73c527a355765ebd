#include "dense_march.hpp"
#include "fields/water_surface_field.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tidemark::fields::water_surface_field_test {

class WaterSurfaceField : public testing::Test {
protected:
    WaterSurfaceField() {
        auto loaded = scene::load_scene(TIDEMARK_SOURCE_DIR "/shaders/water_surface.glsl");
        EXPECT_TRUE(loaded) << to_string(loaded.error());
        scene_ = *std::move(loaded);
        inputs_.knobs = scene_.knobs;
        inputs_.time = 10;
        inputs_.resolution = {48, 27};
        inputs_.mouse = {36, 10.8};
    }
    Reference reference() const {
        auto made = water_surface_reference(inputs_);
        EXPECT_TRUE(made) << to_string(made.error());
        return *std::move(made);
    }
    void set(const char* setting) {
        ASSERT_TRUE(scene::override_knob(scene_, setting));
        inputs_.knobs = scene_.knobs;
    }

    scene::Scene scene_;
    ReferenceInputs inputs_;
};

TEST_F(WaterSurfaceField, HasTheBoundsThatAreProvedByHand) {
    const Field field = reference().field;
    EXPECT_NEAR(0.5 * field.lipschitz, 3.3498, 1e-3);
    EXPECT_NEAR(field.lowest, -4.6583 - 0.6, 1e-3);
    EXPECT_NEAR(field.highest, 0.6, 1e-6);
}

TEST_F(WaterSurfaceField, TheViewStopsAtThePolesOrPassesThePoles) {
    const glm::dvec2 upper_edge{24, 27};
    inputs_.mouse = {24, 4}; // pitch below -90 degrees
    EXPECT_LT(glm::distance(reference().ray({24, 13.5}).direction, {0, -1, 0}), 1e-9);
    EXPECT_GT(reference().ray(upper_edge).direction.z, 0.4);
    inputs_.turning_poles = true;
    EXPECT_LT(reference().ray({24, 13.5}).direction.z, -0.05);
    EXPECT_LT(reference().ray(upper_edge).direction.z, -0.2);
}

TEST_F(WaterSurfaceField, StaysWithinItsBounds) {
    const Field field = reference().field;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> wide(-40, 40), depth(field.lowest, field.highest), unit(-1, 1);
    double steepest = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 p{wide(random), depth(random), wide(random)};
        const glm::dvec3 d = glm::normalize(glm::dvec3{unit(random), unit(random), unit(random)});
        steepest = std::max(steepest, std::abs(field.value(p + 1e-5 * d) - field.value(p)) / 1e-5);
    }
    EXPECT_LT(steepest, field.lipschitz);
    EXPECT_GT(steepest, 2.0); // and the sampling sees the steep places: more than a plane's 1
    EXPECT_GE(field.value({3, field.highest, -5}), 0);
    EXPECT_LE(field.value({3, field.lowest, -5}), 0);
}

TEST_F(WaterSurfaceField, ClearanceContainsNoZero) {
    const Field field = reference().field;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> wide(-20, 20), depth(-3, 1), unit(-1, 1);
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 p{wide(random), depth(random), wide(random)};
        const glm::dvec3 d = glm::normalize(glm::dvec3{unit(random), unit(random), unit(random)});
        const FieldSample sample = field.sample(p, d);
        const double value = field.value(p);
        ASSERT_LE(sample.value, value + 1e-12);
        ASSERT_EQ(sample.value < 0, value < 0);
        for (int k = 1; k <= 8 && value >= 0; ++k)
            ASSERT_GT(field.value(p + sample.clearance * k / 8.001 * d), 0) << i << ' ' << k;
    }
}

TEST_F(WaterSurfaceField, CertifiedMarchAgreesWithADenseMarch) {
    const Reference r = reference();
    int hits = 0;
    for (int y = 0; y < 27; y += 2)
        for (int x = 0; x < 48; x += 3) {
            SCOPED_TRACE(testing::Message() << x << ' ' << y);
            hits += expect_as_dense(r.field, r.ray({x + 0.5, y + 0.5}), r.range, 4e-3);
        }
    EXPECT_GT(hits, 100);
}

TEST_F(WaterSurfaceField, IsAPlaneWithoutOctaves) {
    inputs_.octaves = 0;
    set("bob_height=0");
    const Reference r = reference();
    const Ray ray = r.ray({24, 0.5});
    EXPECT_NEAR(certified_march(r.field, ray, r.range).distance, -ray.origin.y / ray.direction.y, 1e-12);
}

TEST_F(WaterSurfaceField, ProvesNothingBelowZero) {
    set("wave_height=-1");
    const auto made = water_surface_reference(inputs_);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().message,
              "the reference knows no 'wave_height' below 0, and it is -1: its bounds would not hold");
}

TEST_F(WaterSurfaceField, NamesTheMissingKnob) {
    const auto camera_only = std::span(inputs_.knobs).first(4);
    inputs_.knobs = camera_only;
    const auto made = water_surface_reference(inputs_);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().message,
              "the scene has no knob 'bob_height', which its reference needs: declare it "
              "with #iUniform as the scene in shaders/ does");
}

} // namespace tidemark::fields::water_surface_field_test
