// Specialised programs draw the bytes of the plain ones, in our scenes with their features on and off, and in
// each kind of pass.
#include "gl_test.hpp"
#include "host/program_trial.hpp"
#include "scene/load_scene.hpp"
#include "shader/definitions.hpp"
#include "shader/survey.hpp"

#include <gmock/gmock.h>

namespace tidemark::render::specialise_gl_test {

using glsl::Specialise;

const fs::path k_shaders = fs::path(TIDEMARK_SOURCE_DIR) / "shaders";
constexpr Extent k_extent{64, 36};

class SpecialiseTest : public RenderTest {
protected:
    static Renderer made(const scene::Scene& scene, Specialise how) {
        auto renderer = Renderer::create(
            scene, {.extent = k_extent, .samples = image::SampleType::f32, .specialise = how});
        if (!renderer) {
            std::fprintf(stderr, "%s\n", to_string(renderer.error()).c_str());
            std::abort();
        }
        return *std::move(renderer);
    }
    /// Returns the picture of every pass after frames 0 and 1.
    static std::vector<image::Image> drawn(const scene::Scene& scene, Specialise how) {
        Renderer renderer = made(scene, how);
        return drawn(renderer);
    }
    static std::vector<image::Image> drawn(Renderer& renderer) {
        std::vector<image::Image> images;
        for (const int frame : {0, 1}) {
            renderer.draw(inputs_of_frame(frame, 0.37));
            for (const PlannedPass& planned : renderer.plan().passes)
                images.push_back(renderer.read_floats(planned.pass));
        }
        return images;
    }
    static void expect_same_bytes(const scene::Scene& scene) {
        const auto plain = drawn(scene, Specialise::nothing);
        for (const Specialise how : {Specialise::unreachable, Specialise::invariant_uniforms}) {
            Renderer special = made(scene, how);
            for (const PlannedPass& planned : special.plan().passes)
                EXPECT_NE(special.left_out(planned.pass).kept_whole, "the driver rejects the shorter text");
            EXPECT_TRUE(drawn(special) == plain);
        }
    }
    static glsl::LeftOut left_out(const scene::Scene& scene, Specialise how) {
        const Renderer renderer = made(scene, how);
        return renderer.left_out(renderer.shown_index());
    }
};

struct Case {
    const char* scene;
    std::vector<const char*> defines;
};

TEST_F(SpecialiseTest, shipped_scenes_keep_their_bytes_with_features_on_and_off) {
    const std::vector<Case> cases = {
        {"water_surface", {}},    {"pseudo3d_water", {}},
        {"procedural_ocean", {}}, {"procedural_ocean", {"FOAM=0", "FOG=0", "REFLECTION=0", "CLOUDS=0"}},
        {"gerstner_waves", {}},   {"gerstner_waves", {"FOAM=0", "FOG=0", "REFLECTION=0", "CLOUDS=0"}},
        {"stylized_waves", {}},   {"stylized_waves", {"FOAM=0", "SPECULAR=0", "CAUSTIC=0", "SHADOWS=0"}}};
    for (const Case& each : cases) {
        SCOPED_TRACE(each.scene);
        auto scene = scene::load_scene(k_shaders / (std::string(each.scene) + ".glsl"));
        ASSERT_TRUE(scene) << to_string(scene.error());
        for (const char* define : each.defines)
            ASSERT_TRUE(glsl::override_definition(*scene, define)) << define;
        EXPECT_GT(left_out(*scene, Specialise::unreachable).lines, 5);
        expect_same_bytes(*scene);
    }
}

TEST_F(SpecialiseTest, loops_keep_their_bytes) {
    const scene::Scene scene = scene_of(R"(
#iUniform vec2 wind = vec2(1.0, -1.0) in { -2.0, 2.0 }
float unused(vec2 p) { return texture(iChannel0, p).x; }
mat2 turn(float a) { float s = sin(a), c = cos(a); return mat2(c, -s, s, c); }
float map(vec3 p) {
    float angle = 0.3 * iTime + wind.x;
    p.xz *= turn(angle);
    vec3 q = abs(p) - 0.8 - 0.2 * pow(abs(sin(iTime)), 1.7);
    q.x += 0.025 * sin(9.0 * p.y);
    return length(max(q, 0.0)) - 0.125 * exp(-fract(iTime * 0.7));
}
void mainImage(out vec4 colour, vec2 at) {
    vec3 direction = normalize(vec3((2.0 * at - iResolution.xy) / iResolution.y, 2.0));
    float t = 0.0;
    for (int i = 0; i < 80 && t < 12.0; ++i) t += map(vec3(0.0, 0.0, -5.0) + t * direction);
    colour = vec4(t, fwidth(t), direction.xy);
}
)");
    const glsl::LeftOut left = left_out(scene, Specialise::invariant_uniforms);
    EXPECT_EQ(left.loop_invariants, 3);
    EXPECT_GE(left.lines, 1);
    expect_same_bytes(scene);
}

TEST_F(SpecialiseTest, buffers_cubes_and_hits_keep_their_bytes) {
    fs::create_directories(path_of("waves"));
    const std::string common =
        "float turned(float x) { return sin(x + iTime); }\nfloat nobody() { return 1.0; }\n";
    put("waves/common.glsl", common);
    put("waves/buffer_a.glsl",
        "#iChannel0 \"self\"\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(0.0);\n"
        "for (int i = 0; i < 3; ++i) c += turned(1.0) + texelFetch(iChannel0, ivec2(p), 0) * 0.5; }");
    put("waves/cube_a.glsl",
        "void mainCubemap(out vec4 c, vec2 p, vec3 o, vec3 d) { c = vec4(d, turned(d.x)); }");
    put("waves/image.glsl",
        "#iChannel0 \"buffer_a.glsl\"\n#iChannel1 \"cube_a.glsl\"\nvec3 idle(vec3 x) { return x; }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "c = texelFetch(iChannel0, ivec2(p), 0) + texture(iChannel1, vec3(p, 1.0)); }");
    auto scene = scene::load_scene(path_of("waves"));
    ASSERT_TRUE(scene) << to_string(scene.error());
    expect_same_bytes(*scene);

    const scene::Scene marched =
        scene_of("#ifdef TIDEMARK_HIT\nfloat steps = 3.0;\n"
                 "void mainHit(out vec4 hit, in vec2 p) { hit = vec4(p.x, steps, 0.0, 0.0); }\n"
                 "#endif\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(1.0); }");
    const auto asked = glsl::hit_scene(marched);
    ASSERT_TRUE(asked);
    Renderer renderer = made(*asked, Specialise::unreachable);
    EXPECT_EQ(renderer.left_out(0).lines, 1); // mainImage
    EXPECT_EQ(floats_at(frame(renderer), 5, 0), (Floats4{5.5f, 3, 0, 0}));
}

TEST_F(SpecialiseTest, errors_in_unreachable_code_affect_only_the_plain_program) {
    const scene::Scene scene = scene_of("float broken() { return undeclared; }\n"
                                        "void mainImage(out vec4 c, vec2 p) { c = vec4(0.5); }");
    EXPECT_EQ(left_out(scene, Specialise::unreachable).lines, 1);
    const auto plain = Renderer::create(scene, {.extent = k_extent});
    ASSERT_FALSE(plain);
    EXPECT_THAT(to_string(plain.error()), testing::HasSubstr("scene.glsl:1"));
}

TEST_F(SpecialiseTest, errors_are_those_of_the_plain_text) {
    const scene::Scene scene = scene_of("float unused() { return 1.0; }\n\n"
                                        "void mainImage(out vec4 c, vec2 p) {\n    c = undeclared; }");
    const auto special =
        Renderer::create(scene, {.extent = k_extent, .specialise = Specialise::invariant_uniforms});
    const auto plain = Renderer::create(scene, {.extent = k_extent});
    ASSERT_FALSE(special);
    ASSERT_FALSE(plain);
    EXPECT_EQ(to_string(special.error()), to_string(plain.error()));
    EXPECT_THAT(to_string(special.error()), testing::HasSubstr("scene.glsl:4"));
}

TEST_F(SpecialiseTest, a_refused_specialisation_is_drawn_plain) {
    // As a constant the knob is beyond the array, which a driver refuses; as a uniform it is clamped.
    const scene::Scene scene = scene_of("#iUniform int place = 7\nfloat unused() { return 1.0; }\n"
                                        "void mainImage(out vec4 c, vec2 p) {\n"
                                        "    float a[2] = float[2](0.25, 0.75); c = vec4(a[place]); }");
    const glsl::LeftOut left = left_out(scene, Specialise::constants);
    EXPECT_FALSE(left.anything());
    EXPECT_EQ(left.kept_whole, "the driver rejects the shorter text");
    EXPECT_TRUE(drawn(scene, Specialise::constants) == drawn(scene, Specialise::nothing));
}

TEST_F(SpecialiseTest, a_trial_gives_the_plain_bytes_unless_a_difference_is_allowed) {
    const scene::Scene scene =
        scene_of("#iUniform float power = 4.0 in { 1.0, 9.0 }\n"
                 "void mainImage(out vec4 c, vec2 p) {\n"
                 "    for (int i = 0; i < 9; ++i) c += pow(fract(p.x * 0.37 + sin(iTime)), power); }");
    host::TrialPlan plan{inputs_of_frame(0, 60), inputs_of_frame(100, 60), 1'000'000};
    RenderOptions options{.extent = k_extent, .samples = image::SampleType::f32};
    Renderer plain = made(scene, Specialise::nothing);
    const image::Image expected = frame(plain, plan.last);

    options.specialise = Specialise::invariant_uniforms;
    auto trial = host::choose_program(scene, options, plan);
    ASSERT_TRUE(trial);
    EXPECT_EQ(trial->said, "");
    EXPECT_TRUE(frame(trial->renderer, plan.last) == expected);

    options.specialise = Specialise::constants; // the driver makes products of that power
    ASSERT_FALSE(drawn(scene, Specialise::constants) == drawn(scene, Specialise::nothing));
    plan.allowed = 1e-12;
    trial = host::choose_program(scene, options, plan);
    ASSERT_TRUE(trial);
    EXPECT_THAT(trial->said,
                testing::StartsWith("not specialised: it would differ from the plain program by "));
    EXPECT_TRUE(frame(trial->renderer, plan.last) == expected);
}

/// A trial's clock that hands out these shares.
auto pairs(std::vector<double> shares) {
    return [shares, at = size_t{0}]() mutable {
        return at < shares.size() ? std::optional(shares[at++]) : std::nullopt;
    };
}

TEST(Trial, only_a_clear_gain_counts) {
    EXPECT_EQ(host::clear_share(pairs(std::vector(5, 0.5)), 0.97), 0.5);
    EXPECT_EQ(host::clear_share(pairs(std::vector(4, 0.5)), 0.97), std::nullopt); // too few for an interval
    EXPECT_EQ(host::clear_share(pairs(std::vector(100, 0.97)), 0.97), std::nullopt);
    EXPECT_EQ(host::clear_share(pairs({}), 0.97), std::nullopt);
    // Every third pair was disturbed, the first ones too: a few more make it clear.
    std::vector<double> disturbed;
    for (int i = 0; i < 60; ++i)
        disturbed.push_back(i % 3 == 0 ? 7.0 : 0.5);
    EXPECT_EQ(host::clear_share(pairs(disturbed), 0.97), 0.5);
    for (double& share : disturbed)
        share *= 2; // no gain at all
    EXPECT_EQ(host::clear_share(pairs(disturbed), 0.97), std::nullopt);
}

/// The saving is a factor beyond what a busy machine makes of a measurement.
TEST_F(SpecialiseTest, a_trial_takes_the_program_that_saves_most_of_the_work) {
    const scene::Scene scene = scene_of(R"(
void mainImage(out vec4 c, vec2 p) {
    for (int i = 0; i < 2000; ++i)
        c += p.x * pow(abs(sin(iTime)), 1.7) + pow(abs(cos(iTime)), 2.3) * p.y + pow(abs(sin(iTime * 3.1)), 0.9);
})");
    const host::TrialPlan plan{inputs_of_frame(0, 60), inputs_of_frame(100, 60), 1'000'000};
    auto trial = host::choose_program(
        scene,
        {.extent = k_extent, .samples = image::SampleType::f32, .specialise = Specialise::invariant_uniforms},
        plan);
    ASSERT_TRUE(trial);
    EXPECT_EQ(trial->renderer.left_out(0).loop_invariants, 3);
    Renderer plain = made(scene, Specialise::nothing);
    EXPECT_TRUE(frame(trial->renderer, plan.last) == frame(plain, plan.last));
}

} // namespace tidemark::render::specialise_gl_test
