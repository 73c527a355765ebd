// Scenes in double precision: the picture is that of floats where floats suffice, and better where they do
// not.
#include "gl_test.hpp"
#include "render/sound_renderer.hpp"
#include "scene/load_scene.hpp"
#include "shader/survey.hpp"
#include "support/largest_difference.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace tidemark::render::precision_gl_test {

using glsl::Precision;
using image::Image;
using image::SampleType;
using testing::HasSubstr;

class PrecisionTest : public RenderTest {
protected:
    Renderer drawn_in(const std::string& text, Precision precision, Extent extent) const {
        auto made = Renderer::create(scene_of(text), {extent, SampleType::f32, {}, precision});
        if (!made) {
            std::fprintf(stderr, "%s\n", to_string(made.error()).c_str());
            std::abort();
        }
        return *std::move(made);
    }
    Image picture(const std::string& text, Precision precision, const FrameInputs& inputs = {},
                  Extent extent = {48, 32}) const {
        Renderer drawing = drawn_in(text, precision, extent);
        return frame(drawing, inputs);
    }
    /// The first red of a promoted shader, with what it lost as a float in green.
    double told_in_double(const std::string& expression, const FrameInputs& inputs = {},
                          const std::string& before = {}) const {
        const auto less =
            [&](double by) { // a driver may take double(float(v)) for v: the float comes back as a constant
                const std::string text =
                    fmt::format("{}\nvoid mainImage(out vec4 c, in vec2 p) {{ float v = {};"
                                " c = vec4(v - ({:.17e}), 0, 0, 1); }}\n",
                                before, expression, by);
                return double(floats_at(picture(text, Precision::promoted, inputs, {1, 1}), 0, 0)[0]);
            };
        const double high = less(0);
        return high + less(high);
    }
};

/// Everything that is smooth: two ways to compute the same picture, apart by what floats lose.
TEST_F(PrecisionTest, smooth_pictures_equal_those_in_floats) {
    const std::pair<const char*, double> smooth[] = {
        {"void mainImage(out vec4 c, in vec2 p) { vec2 q = p / iResolution.xy;"
         " c = vec4(0.5 + 0.5 * sin(6.0 * q + iTime), exp(-q.x), pow(q.y, 1.7)); }",
         1e-5},
        {"float field(vec3 p) { return length(p) - 1.0 - 0.05 * cos(5.0 * p.x) * tanh(p.y); }\n"
         "void mainImage(out vec4 c, in vec2 p) {\n"
         "    vec3 d = normalize(vec3((2.0 * p - iResolution.xy) / iResolution.y, -2.0)), o = vec3(0, 0, "
         "4);\n"
         "    float t = 0.0;\n"
         "    for (int i = 0; i < 60; i++) t += 0.8 * field(o + t * d);\n"
         "    vec3 h = o + t * d;\n"
         "    c = t < 8.0 ? vec4(0.5 + 0.5 * h, 1) : vec4(atan(d.y, d.x), acos(d.x), log(2.0 + d.y), 1) * "
         "0.2; }",
         1e-4},
        // Filters weigh in steps of 1/256, and a coordinate may fall on either side.
        {"void mainImage(out vec4 c, in vec2 p) {\n"
         "    mat2 r = mat2(cos(0.3), sin(0.3), -sin(0.3), cos(0.3));\n"
         "    vec2 q = r * p / iResolution.x;\n"
         "    c = mix(vec4(q, asin(q.x), 1), texture(iChannel0, q), 0.25) * smoothstep(0.0, 1.0, q.x); }",
         2e-3},
    };
    const FrameInputs inputs = inputs_of_frame(30, 60);
    for (const auto& [text, limit] : smooth) {
        const Image single = picture(text, Precision::single, inputs);
        const Image promoted = picture(text, Precision::promoted, inputs);
        const double difference = largest_difference(single, promoted);
        EXPECT_LT(difference, limit) << text;
        EXPECT_GT(difference, 0.0) << "not promoted: " << text;
    }
}

TEST_F(PrecisionTest, a_day_of_seconds_keeps_its_phase) {
    FrameInputs inputs;
    inputs.time = 1e7 + 0.123456789;
    const double phase = told_in_double("fract(iTime)", inputs);
    EXPECT_NEAR(phase, inputs.time - 1e7, 1e-9);
    EXPECT_NEAR(told_in_double("sin(iTime)", inputs), std::sin(inputs.time), 1e-9);
    EXPECT_EQ(told({"fract(iTime)"}, inputs).at(0), 0.0f) << "floats cannot";
    EXPECT_EQ(told_in_double("iTimeLow", inputs, "uniform float iTimeLow;"), 0) << "nothing is left";
}

TEST_F(PrecisionTest, every_uniform_arrives_as_a_double) {
    FrameInputs inputs = inputs_of_frame(7, 30);
    inputs.mouse = {3, 4, 3, -4};
    inputs.date = {2024, 11, 31, 86399.998046875};
    for (const auto& [expression, value] : std::initializer_list<std::pair<const char*, double>>{
             {"iTime", 7 / 30.0},
             {"iTimeDelta", 1 / 30.0},
             {"iFrameRate", 30},
             {"float(iFrame)", 7},
             {"iResolution.z", 1},
             {"iMouse.w", -4},
             {"iDate.w", 86399.998046875},
             {"iSampleRate", 44100},
             {"max(iChannelResolution[0].x, texture(iChannel0, p).x)", 256}})
        EXPECT_NEAR(told_in_double(expression, inputs), value, std::abs(value) * 1e-14) << expression;
    EXPECT_NEAR(told_in_double("height", {}, "#iUniform float height = 0.1"), 0.1, 1e-15);
}

TEST_F(PrecisionTest, derivatives_are_computed_in_double) {
    const std::string text = "void mainImage(out vec4 c, in vec2 p) { float far = 1e9 + p.x * 1e-3;"
                             " c = vec4(dFdx(far), fwidth(far), dFdy(far), 1); }";
    const Image promoted = picture(text, Precision::promoted, {}, {8, 8});
    const Floats4 pixel = floats_at(promoted, 3, 3);
    EXPECT_NEAR(pixel[0], 1e-3, 1e-6);
    EXPECT_NEAR(pixel[1], 1e-3, 1e-6);
    EXPECT_EQ(pixel[2], 0.0f);
    EXPECT_EQ(floats_at(picture(text, Precision::single, {}, {8, 8}), 3, 3)[0], 0.0f);
}

constexpr const char* k_hashes = R"(
float scatter(vec2 p) { return fract(sin(dot(p, vec2(127.1, 311.7))) * 43758.5453); }
float mixed(vec2 p) {
    vec3 q = fract(vec3(p.xyx) * .1031);
    q += dot(q, q.yzx + 33.33);
    return fract((q.x + q.y) * q.z);
}
void mainImage(out vec4 c, in vec2 p) {
    vec2 i = floor(p * 1.7);
    c = vec4(scatter(i), mixed(i), fract(sin(i.x * 12.9898 + i.y) * 43758.5453), 1);
}
)";

TEST_F(PrecisionTest, hashes_equal_those_in_floats_bit_by_bit) {
    const Image single = picture(k_hashes, Precision::single);
    EXPECT_EQ(picture(k_hashes, Precision::promoted), single);
    EXPECT_GT(largest_difference(picture(k_hashes, Precision::promoted_whole), single), 0.1);
}

TEST_F(PrecisionTest, hashes_are_reported) {
    const Renderer promoted = drawn_in(k_hashes, Precision::promoted, {4, 4});
    std::vector<std::string> found;
    for (const glsl::KeptHash& hash : promoted.kept_hashes(0))
        found.push_back(fmt::format("{} {} {}", hash.function, hash.where.line, to_string(hash.kind)));
    EXPECT_THAT(found, testing::ElementsAre("scatter 2 sine", "mixed 3 product", "mainImage 10 sine"));
    EXPECT_TRUE(drawn_in(k_hashes, Precision::promoted_whole, {4, 4}).kept_hashes(0).empty());
}

/// Floats cannot tell the neighbours apart here; doubles draw the whole gradient.
TEST_F(PrecisionTest, a_deep_zoom_resolves_every_pixel) {
    const std::string text = "void mainImage(out vec4 c, in vec2 p) {"
                             " vec2 z = vec2(-1.25, 0.125) + p * 1e-12; c = vec4((z.x + 1.25) * 1e11); }";
    const Image promoted = picture(text, Precision::promoted, {}, {8, 1});
    for (int x = 0; x < 8; ++x)
        EXPECT_NEAR(floats_at(promoted, x, 0)[0], (x + 0.5) * 0.1, 1e-4);
}

TEST_F(PrecisionTest, buffers_between_passes_hold_floats) {
    put("buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0 / 3.0, p, 1); }");
    put("image.glsl", "#iChannel0 \"buffer_a.glsl\"\n"
                      "void mainImage(out vec4 c, in vec2 p) {"
                      " c = vec4((texelFetch(iChannel0, ivec2(p), 0).x - 1.0 / 3.0) * 1e6, 0, 0, 1); }");
    auto scene = scene::load_scene(path_of("image.glsl"));
    ASSERT_TRUE(scene) << to_string(scene.error());
    auto made = Renderer::create(*std::move(scene), {{2, 2}, SampleType::f32, {}, Precision::promoted});
    ASSERT_TRUE(made) << to_string(made.error());
    const double lost = double(float(1.0 / 3.0)) - 1.0 / 3.0;
    EXPECT_NEAR(floats_at(frame(*made), 1, 1)[0], lost * 1e6, 1e-9);
}

TEST_F(PrecisionTest, hits_are_computed_in_double) {
    const auto hits = glsl::hit_scene(scene_of("void mainImage(out vec4 c, in vec2 p) { c = vec4(0); }\n"
                                               "#ifdef TIDEMARK_HIT\n"
                                               "void mainHit(out vec4 hit, in vec2 p) {"
                                               " hit = vec4((1e9 + p.x) - 1e9, 3, 0, 1); }\n#endif\n"));
    ASSERT_TRUE(hits);
    auto made = Renderer::create(*hits, {{4, 1}, SampleType::f32, {}, Precision::promoted});
    ASSERT_TRUE(made) << to_string(made.error());
    EXPECT_EQ(floats_at(frame(*made), 2, 0), (Floats4{2.5f, 3, 0, 1}));
}

TEST_F(PrecisionTest, code_without_a_double_form_is_named_at_its_place) {
    auto made = Renderer::create(scene_of("void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(1);\n"
                                          "    gl_FragDepth = 0.5;\n}\n"),
                                 {{2, 2}, SampleType::u8, {}, Precision::promoted});
    ASSERT_FALSE(made);
    EXPECT_THAT(to_string(made.error()),
                HasSubstr("scene.glsl:3:5: error: 'gl_FragDepth' has no form in double precision"));
}

TEST_F(PrecisionTest, faults_keep_the_authors_lines) {
    auto made = Renderer::create(scene_of("float a = 1.0;\n\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                                          "    c = vec4(missing(sin(a)));\n}\n"),
                                 {{2, 2}, SampleType::u8, {}, Precision::promoted});
    ASSERT_FALSE(made);
    EXPECT_THAT(to_string(made.error()), HasSubstr("does not compile in double precision"));
    EXPECT_THAT(to_string(made.error()), testing::ContainsRegex("scene\\.glsl:4(:[0-9]+)?: error:"));
}

} // namespace tidemark::render::precision_gl_test
