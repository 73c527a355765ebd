#include "gl_test.hpp"
#include "media/image.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "shader/definitions.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace tidemark::render::stylized_waves_gl_test {

using image::Image;
using scene::Knob;
using scene::KnobValue;
using scene::Scene;

constexpr Extent k_small{48, 27};

class StylizedWaves : public RenderTest {
protected:
    static Scene waves(const std::vector<std::string>& defines = {}) {
        auto scene = scene::load_scene(fs::path(TIDEMARK_SOURCE_DIR) / "shaders/stylized_waves.glsl");
        EXPECT_TRUE(scene) << to_string(scene.error());
        for (const std::string& define : defines)
            EXPECT_TRUE(glsl::override_definition(*scene, define)) << define;
        return *std::move(scene);
    }
    Image drawn(Scene scene, const FrameInputs& inputs = at(3.0), Extent extent = k_small) const {
        Renderer drawing = renderer(std::move(scene), extent);
        return frame(drawing, inputs);
    }
    static FrameInputs at(double seconds) {
        FrameInputs inputs;
        inputs.time = seconds;
        return inputs;
    }
    static FrameInputs looking_at(glm::vec2 pixel) {
        FrameInputs inputs = at(3.0);
        inputs.mouse = {pixel, 0.0F, 0.0F};
        return inputs;
    }
    static std::vector<std::string> views() { return {"TOP_VIEW=0", "TOP_VIEW=1"}; }

    /// Mean distance of the samples.
    static double apart(const Image& a, const Image& b) {
        double sum = 0.0;
        for (size_t i = 0; i < a.samples(); ++i)
            sum += std::abs(double(a.f32()[i]) - double(b.f32()[i]));
        return sum / double(a.samples());
    }
};

TEST_F(StylizedWaves, every_knob_changes_the_picture) {
    const Scene game = waves();
    const FrameInputs low = looking_at({24.0F, 2.0F}); // land, water and sky
    const Image as_it_is = drawn(game, low);
    for (size_t i = 0; i < game.knobs.size(); ++i) {
        Scene turned = game;
        Knob& knob = turned.knobs[i];
        if (knob.name == "map_height" || knob.name == "document_mouse")
            continue; // of the map alone; of a camera that was moved (shipped_scenes_gl_test)
        if (!knob.range) {
            for (double& component : knob.value) // a colour
                component = 1.0 - component;
        } else {
            const KnobValue& lowest = knob.range->low;
            knob.value = knob.value == lowest ? knob.range->high : lowest;
        }
        EXPECT_GT(apart(drawn(turned, low), as_it_is), 1e-5) << knob.name;
    }
    Scene map = waves({"TOP_VIEW=1"});
    const Image whole = drawn(map);
    ASSERT_TRUE(scene::override_knob(map, "map_height=30"));
    EXPECT_GT(apart(drawn(map), whole), 1e-3);
}

TEST_F(StylizedWaves, no_pixel_is_a_nan_or_infinite_at_the_ends_of_the_ranges) {
    std::mt19937 random(1);
    for (int round = 0; round < 12; ++round) {
        Scene scene = waves({views()[size_t(round) % 2]});
        for (Knob& knob : scene.knobs)
            for (size_t component = 0; component < 4; ++component) {
                const double low = knob.range ? knob.range->low[component] : 0.0;
                const double high = knob.range ? knob.range->high[component] : 1.0;
                knob.value[component] = random() % 2 == 0 ? low : high;
            }
        FrameInputs inputs = at(round == 0 ? 0.0 : 1e3 * double(random() % 1000));
        inputs.mouse = {float(random() % 48), float(random() % 27), 0.0F, 0.0F};
        EXPECT_EQ(image::census(drawn(scene, inputs)).non_finite(), 0U) << "round " << round;
    }
}

TEST_F(StylizedWaves, disabled_features_are_not_in_the_program) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> features{
        {"FOAM=0", {"foam_front", "foam_tail", "foam_rollback", "foam_depth", "foam_scale", "foam_color"}},
        {"FOAM=1", {"foam_tail", "foam_rollback"}},
        {"FOAM=2", {"foam_rollback"}},
        {"SPECULAR=0", {"specular", "specular_exponent"}},
        {"CAUSTIC=0", {"caustic_strength", "caustic_scale"}},
        {"REFRACTION=0", {"refraction"}},
        {"CLOUDS=0", {"clouds"}},
        {"TOP_VIEW=1", {"camera_distance", "camera_target", "focal_length"}},
        {"TOP_VIEW=0", {"map_height"}},
    };
    const FrameInputs low = looking_at({24.0F, 2.0F}); // land, water and sky
    const Image everything = drawn(waves(), low);
    for (const auto& [define, knobs] : features) {
        Renderer drawing = renderer(waves({define}), k_small);
        const auto& reflection = drawing.program(0).reflection();
        for (const std::string& knob : knobs)
            EXPECT_EQ(reflection.find(knob.c_str()), nullptr) << define << " leaves " << knob;
        EXPECT_NE(reflection.find("wave_length"), nullptr);
        if (define != "TOP_VIEW=0") {
            EXPECT_GT(apart(frame(drawing, low), everything), 1e-5) << define;
        }
    }
    EXPECT_GT(apart(drawn(waves({"SHADOWS=0"}), low), everything), 1e-4);
}

TEST_F(StylizedWaves, a_wave_follows_the_next_after_the_period_and_time_has_no_jump) {
    // Everything that moves but the waves stands still.
    Scene scene = waves({"FOAM=0", "CAUSTIC=0", "SPECULAR=0"});
    for (const char* setting : {"ripples=0", "wave_speed=-4"})
        ASSERT_TRUE(scene::override_knob(scene, setting));
    Renderer drawing = renderer(scene, k_small);
    const auto picture = [&](double seconds) { return frame(drawing, at(seconds)); };
    const Image start = picture(1.0);
    EXPECT_LT(apart(picture(5.0), start), 1e-5);
    EXPECT_GT(apart(picture(3.0), start), 3e-3);
    // iTime is a float: near a million seconds it has steps of 1/16 s, and 1 and 1000001 are among them.
    EXPECT_LT(apart(picture(1e6 + 1.0), start), 1e-5);
    // The same sixteenth of a second later, each time.
    const auto step = [&](double seconds) { return apart(picture(seconds), picture(seconds + 0.0625)); };
    for (const double seconds : {1023.9375, 999999.9375, 1048575.9375})
        EXPECT_NEAR(step(seconds), step(3.9375), 1e-5) << seconds;
}

TEST_F(StylizedWaves, motion_is_continuous_at_the_end_of_each_period) {
    // Every movement's period ends at some time of these; a jump would show as another picture.
    Renderer drawing = renderer(waves(), k_small);
    const auto picture = [&](double seconds) { return frame(drawing, at(seconds)); };
    const double usual = apart(picture(3.0), picture(3.0 + 1.0 / 64.0));
    for (const double wrap :
         {1.0 / 0.23, 1.0 / 0.11, 4.0, 256.0, 1.0 / 0.05, 1.0 / 0.03, 1e3 / 0.83, 1e5 / 0.6})
        EXPECT_LT(apart(picture(wrap - 1.0 / 128.0), picture(wrap + 1.0 / 128.0)), 3.0 * usual) << wrap;
}

TEST_F(StylizedWaves, waves_run_inwards) {
    Scene scene = waves({"TOP_VIEW=1", "FOAM=0", "CAUSTIC=0", "SPECULAR=0"});
    for (const char* setting : {"ripples=0", "bend=0", "map_height=64", "wave_length=6.4", "wave_speed=-4"})
        ASSERT_TRUE(scene::override_knob(scene, setting));
    Renderer drawing = renderer(scene, {64, 64}); // a metre a pixel
    const Image before = frame(drawing, at(0.0)), after = frame(drawing, at(2.5));
    // 5/8 of a period later a wave is 4 m nearer to the middle. All of this is open sea, east of the island.
    double inwards = 0.0, outwards = 0.0;
    for (int x = 56; x < 60; ++x) {
        inwards += std::abs(floats_at(after, x, 32)[1] - floats_at(before, x + 4, 32)[1]);
        outwards += std::abs(floats_at(after, x, 32)[1] - floats_at(before, x - 4, 32)[1]);
    }
    EXPECT_LT(inwards, 0.25 * outwards);
}

// The hit as the lab reads it.
TEST_F(StylizedWaves, hits_are_on_the_surface_and_report_their_cost) {
    for (const std::string& view : views()) {
        const std::string text =
            "#define TIDEMARK_HIT 1\n#define mainImage picture\n#include \"" +
            std::string(TIDEMARK_SOURCE_DIR) +
            "/shaders/stylized_waves.glsl\"\n#undef mainImage\n"
            "void mainImage(out vec4 c, in vec2 p) { mainHit(c, p); c.z = march_field(c.x); }\n";
        auto scene = scene::load_scene(put("hit.glsl", text), {.media = {}, .allow_outside = true});
        ASSERT_TRUE(scene) << to_string(scene.error());
        ASSERT_TRUE(glsl::override_definition(*scene, view));
        const FrameInputs inputs = looking_at({48.0F, 4.0F});
        const Image hits = drawn(*scene, inputs, {96, 54});
        int misses = 0, near = 0;
        float most = 0.0F;
        for (int y = 0; y < 54; ++y)
            for (int x = 0; x < 96; ++x) {
                const Floats4 hit = floats_at(hits, x, y);
                misses += hit[0] < 0.0F;
                near += hit[0] < 0.0F || std::abs(hit[2]) < 0.001F * hit[0];
                most = std::max(most, hit[1]);
            }
        EXPECT_LT(most, 524.0F); // 512 steps, and some to come back
        EXPECT_GT(most, 1.0F);
        EXPECT_GT(near, 96 * 54 * 99 / 100) << view;
        if (view == "TOP_VIEW=1") {
            EXPECT_EQ(misses, 0);
        } else {
            EXPECT_GT(misses, 100);
            EXPECT_LT(misses, 96 * 54 / 2);
        }
    }
}

} // namespace tidemark::render::stylized_waves_gl_test
