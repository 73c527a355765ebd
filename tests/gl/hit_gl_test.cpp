#include "gl_test.hpp"
#include "shader/survey.hpp"

namespace tidemark::render::hit_gl_test {

using HitTest = RenderTest;

/// Beside a buffer that the rays read.
constexpr const char* k_scene = R"(
#iChannel0 "field.glsl"
float field(vec2 p) { return texelFetch(iChannel0, ivec2(p), 0).x; }
void mainImage(out vec4 c, in vec2 p) { c = vec4(field(p)); }
#if TIDEMARK_HIT
void mainHit(out vec4 hit, in vec2 p) {
    hit = vec4(p.x < 2.0 ? -1.0 : 123456.5, 7.0, field(p), 5.0);
}
#endif
)";

TEST_F(HitTest, is_read_back_bit_by_bit) {
    put("field.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(-0.1 - iTime); }");
    const auto scene = glsl::hit_scene(scene_of(k_scene));
    ASSERT_TRUE(scene);
    auto drawing = Renderer::create(*scene, {{4, 3}, image::SampleType::f32, ""});
    ASSERT_TRUE(drawing) << to_string(drawing.error());
    FrameInputs inputs;
    inputs.time = 2;
    drawing->draw(inputs);
    const image::Image image = drawing->read_back();
    EXPECT_EQ(floats_at(image, 1, 2), (Floats4{-1.0f, 7.0f, -2.1f, 5.0f}));
    EXPECT_EQ(floats_at(image, 2, 0), (Floats4{123456.5f, 7.0f, -2.1f, 5.0f}));
}

TEST_F(HitTest, errors_have_the_author_s_lines) {
    const auto scene =
        glsl::hit_scene(scene_of("void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n"
                                 "void mainHit(out vec4 hit, in vec2 p) { hit = nothing; }\n"));
    const auto drawing = Renderer::create(*scene, {{4, 3}, image::SampleType::f32, ""});
    ASSERT_FALSE(drawing);
    ASSERT_FALSE(drawing.error().diagnostics.empty());
    EXPECT_EQ(drawing.error().diagnostics[0].where.line, 2);
}

} // namespace tidemark::render::hit_gl_test
