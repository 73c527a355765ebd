// The first march of a pixel, recorded on the device, equals the one evaluated from the text, and the picture
// is that of the plain text to the bit.
#include "gl_test.hpp"
#include "lab/hits.hpp"
#include "lab/march_hits.hpp"
#include "shader/survey.hpp"
#include "support/scene_of.hpp"

#include <fmt/format.h>

namespace tidemark::lab::recorded_hits_gl_test {

constexpr Extent k_extent{48, 27};

/// A sphere of radius 1 at z = 4.
scene::Scene marcher(const std::string& march, const std::string& before = {}) {
    return scene_of("float map(vec3 p) { return length(p - vec3(0.0, 0.0, 4.0)) - 1.0; }\n" + before +
                    "void mainImage(out vec4 c, in vec2 f) {\n"
                    "    vec3 rd = normalize(vec3(2.0 * f / iResolution.xy - 1.0, 2.0));\n"
                    "    float t = 0.0;\n" +
                    march + "\n    c = vec4(t, sin(t), exp(-t), 1.0); }\n");
}

render::Renderer renderer_of(const scene::Scene& scene) {
    auto renderer = render::Renderer::create(scene, {.extent = k_extent, .samples = image::SampleType::f32});
    EXPECT_TRUE(renderer) << to_string(renderer.error());
    return *std::move(renderer);
}

struct Recorded {
    bool sees_below = false;
    RecordingCheck check;
    Hits hits;
};

Recorded recorded(const scene::Scene& scene) {
    const auto function = PassFunction::create(scene, scene.image());
    EXPECT_TRUE(function);
    const auto recording = record_hits(scene, *function);
    EXPECT_TRUE(recording) << recording.error().message;
    render::Renderer plain = renderer_of(scene), recorder = renderer_of(recording->scene);
    Recorded result{recording->sees_below, {}, {}};
    render::FrameState state;
    state.extent = k_extent;
    result.check = check_recording(plain, recorder, *function, state);
    result.hits = hits_of(recorder.read_back());
    return result;
}

size_t count(const Hits& hits, int flag) {
    return size_t(std::ranges::count_if(hits.flags, [&](uint8_t flags) { return (flags & flag) != 0; }));
}

size_t met(const Hits& hits) {
    return size_t(std::ranges::count_if(hits.distance, [](double distance) { return distance >= 0; }));
}

/// Returns the distance of the sphere in the middle of the picture.
double middle(const Hits& hits) {
    return hits.distance[size_t(k_extent.height / 2 * k_extent.width + k_extent.width / 2)];
}

TEST(RecordedHits, are_recorded_for_the_common_forms_of_a_march) {
    for (
        const char* march : {
            "for (int i = 0; i < 99; ++i) { float d = map(rd * t); if (d < 1e-3 || t > 9.0) break; t += d; }",
            "for (int i = 0; i < 99; i++) { float d = map(rd * t); t += d; if (abs(d) < 1e-3 || t > 9.0) "
            "break; "
            "}",
            "for (int i = 0; i < 99 && t < 9.0; ++i) { float d = map(rd * t); if (d < 1e-3 * t) break; t += "
            "d; }",
            "float d = 1.0; for (int i = 0; i < 99 && d > 1e-3 && t < 9.0; ++i) { d = map(rd * t); t += d; }",
            "float d = 1.0; for (int i = 0; i < 99; ++i) { if (d < 1e-3 || t > 9.0) break; d = map(rd * t); "
            "t += "
            "d; }",
            "float d = 1.0; while (d > 1e-3 && t < 9.0) { d = map(rd * t); t += d; }",
            "float d; for (float i = 0.0; i++ < 99.0 && t < 9.0;) if ((d = map(rd * t)) < 1e-3) break;\n"
            "else t += d;",
            "vec3 p = vec3(0.0); for (int i = 0; i < 99; ++i) { float d = map(p); if (d < 1e-3 || p.z > "
            "9.0)\n"
            "break; p += rd * d; } t = length(p);",
        }) {
        const Recorded of = recorded(marcher(march));
        EXPECT_EQ(of.check.other_pixels, 0u) << march;
        EXPECT_GT(of.check.rays, 50u) << march;
        EXPECT_EQ(of.check.agree, of.check.rays) << march;
        EXPECT_TRUE(of.sees_below) << march;
        EXPECT_GT(met(of.hits), 100u) << march;
        EXPECT_LT(met(of.hits), 600u) << march;
        EXPECT_NEAR(middle(of.hits), 3.0, 0.01) << march;
        EXPECT_EQ(count(of.hits, glsl::k_hit_negative), 0u) << march;
    }
}

TEST(RecordedHits, detect_too_long_and_too_few_steps) {
    const char* march =
        "for (int i = 0; i < {}; ++i) {{ float d = map(rd * t); if (d < 1e-3 || t > 9.0) break; "
        "t += {}; }}";
    const Recorded long_steps = recorded(marcher(fmt::format(fmt::runtime(march), 99, "max(d, 0.4)")));
    EXPECT_GT(count(long_steps.hits, glsl::k_hit_negative), 50u);
    EXPECT_EQ(count(long_steps.hits, glsl::k_hit_exhausted), 0u);
    const Recorded few_steps = recorded(marcher(fmt::format(fmt::runtime(march), 3, "d")));
    EXPECT_GT(count(few_steps.hits, glsl::k_hit_exhausted), 50u);
    EXPECT_EQ(count(few_steps.hits, glsl::k_hit_negative), 0u);
    EXPECT_EQ(few_steps.check.other_pixels, 0u);
}

TEST(RecordedHits, come_from_the_first_march_only) {
    const std::string trace =
        "float trace(vec3 ro, vec3 rd) { float t = 0.0; for (int i = 0; i < 99; ++i) {\n"
        "float d = map(ro + rd * t); if (d < 1e-3 || t > 9.0) break;\n t += d; } return t; }\n";
    const Recorded of = recorded(marcher("t = trace(vec3(0.0), rd);\n"
                                         "if (t < 9.0) t += 0.1 * trace(rd * t * 0.99, vec3(0.0, 1.0, 0.0));",
                                         trace));
    EXPECT_EQ(of.check.other_pixels, 0u);
    EXPECT_EQ(of.check.agree, of.check.rays);
    EXPECT_NEAR(middle(of.hits), 3.0, 0.01);
}

TEST(RecordedHits, do_not_flag_negative_samples_of_a_sign_test_march) {
    const Recorded of =
        recorded(marcher("for (int i = 0; i < 400; ++i) { t += 0.02; if (map(rd * t) < 0.0) break; }"));
    EXPECT_FALSE(of.sees_below);
    EXPECT_EQ(of.check.agree, of.check.rays);
    EXPECT_EQ(count(of.hits, glsl::k_hit_negative), 0u);
}

TEST(RecordedHits, are_refused_for_ambiguous_marches) {
    const scene::Scene flat = scene_of("void mainImage(out vec4 c, in vec2 f) { c = vec4(1.0); }\n");
    const auto function = PassFunction::create(flat, flat.image());
    ASSERT_TRUE(function);
    const auto recording = record_hits(flat, *function);
    ASSERT_FALSE(recording);
    EXPECT_EQ(recording.error().message, "no ray-marching loop found in Image");
    EXPECT_EQ(refusal_of({.rays = 100, .agree = 50}),
              "of 100 recorded rays only 50 agree with those computed from the text");
    EXPECT_EQ(refusal_of({.rays = 100, .agree = 100, .other_pixels = 3}),
              "the instrumented text changes 3 pixels");
    EXPECT_EQ(refusal_of({.rays = 100, .textured = 100}), "");
}

} // namespace tidemark::lab::recorded_hits_gl_test
