#include "gl_test.hpp"
#include "media/image.hpp"
#include "render/gl_context.hpp"
#include "shader/shader_source.hpp"

#include <gmock/gmock.h>

namespace tidemark::render::renderer_gl_test {

using image::Image;
using image::SampleType;
using testing::HasSubstr;

constexpr const char* k_places = R"(
void mainImage(out vec4 c, in vec2 p) {
    c = vec4(floor(p.x) / 255.0, floor(p.y) / 255.0, 51.0 / 255.0, 0.3);
}
)";

/// Another picture in every frame, and floats that do not fit a byte.
constexpr const char* k_moving = R"(
void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    c = vec4(fract(sin(dot(p, vec2(12.9898, 78.233)) + iTime) * 437.5), uv * fract(0.37 * float(iFrame)),
             iTimeDelta);
}
)";

using RendererTest = RenderTest;

TEST_F(RendererTest, draws_computed_pixels) {
    Renderer drawing = renderer(k_places, {37, 11}, SampleType::u8);
    const Image image = frame(drawing);
    ASSERT_EQ(image.extent, (Extent{37, 11}));
    ASSERT_EQ(image.channels, 4);
    for (int y = 0; y < 11; ++y)
        for (int x = 0; x < 37; ++x)
            ASSERT_EQ(bytes_at(image, x, y), (Bytes4{x, y, 51, 255})) << x << ',' << y;
}

TEST_F(RendererTest, row_0_is_the_bottom_and_coordinates_are_pixel_centres) {
    Renderer drawing =
        renderer("void mainImage(out vec4 c, in vec2 p) { c = vec4(p, gl_FragCoord.xy); }", {3, 2});
    const Image image = frame(drawing);
    EXPECT_EQ(floats_at(image, 0, 0), (Floats4{0.5f, 0.5f, 0.5f, 1.0f}));
    EXPECT_EQ(floats_at(image, 2, 1), (Floats4{2.5f, 1.5f, 2.5f, 1.0f}));
}

TEST_F(RendererTest, same_frame_twice_gives_the_same_bytes) {
    for (const SampleType samples : {SampleType::u8, SampleType::f32}) {
        Renderer drawing = diligent_renderer(k_moving, {64, 48}, samples);
        const Image first = frame(drawing, inputs_of_frame(5, 60));
        EXPECT_EQ(frame(drawing, inputs_of_frame(5, 60)), first);
        EXPECT_NE(frame(drawing, inputs_of_frame(6, 60)), first);
        Renderer again = renderer(k_moving, {64, 48}, samples);
        EXPECT_EQ(frame(again, inputs_of_frame(5, 60)), first);
    }
}

TEST_F(RendererTest, frame_after_steps_equals_frame_drawn_directly) {
    Renderer stepping = renderer(k_moving, {64, 48});
    for (int i = 0; i < 9; ++i)
        stepping.draw(inputs_of_frame(i, 24));
    Renderer asked = renderer(k_moving, {64, 48});
    EXPECT_EQ(frame(stepping, inputs_of_frame(9, 24)), frame(asked, inputs_of_frame(9, 24)));
}

/// Buffer A, which iChannel0 reads, is drawn although the text does not say iChannel0.
TEST_F(RendererTest, a_sampler_of_the_author_s_reads_channel_0) {
    put("buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.25, p.x, 0.75, 1.0); }\n");
    Renderer drawing =
        renderer("#iChannel0 \"buffer_a.glsl\"\nuniform sampler2D picture;\n"
                 "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(picture, ivec2(p), 0); }\n",
                 {3, 2});
    EXPECT_EQ(floats_at(frame(drawing), 2, 1), (Floats4{0.25f, 2.5f, 0.75f, 1.0f}));
}

TEST_F(RendererTest, alpha_is_always_1) {
    for (const char* alpha : {"0.0", "0.5", "-3.0", "7.0"}) {
        const std::string text =
            fmt::format("void mainImage(out vec4 c, in vec2 p) {{ c = vec4(0.2, 0.4, 0.6, {}); }}", alpha);
        Renderer bytes = renderer(text, {2, 2}, SampleType::u8);
        EXPECT_EQ(bytes_at(frame(bytes), 1, 1), (Bytes4{51, 102, 153, 255})) << alpha;
        Renderer floats = renderer(text, {2, 2}, SampleType::f32);
        EXPECT_EQ(floats_at(frame(floats), 1, 1), (Floats4{0.2f, 0.4f, 0.6f, 1.0f})) << alpha;
    }
}

TEST_F(RendererTest, bytes_are_clamped) {
    Renderer drawing = renderer("void mainImage(out vec4 c, in vec2 p) { c = vec4(-1.0, 2.0, 1e30, 1.0); }",
                                {1, 1}, SampleType::u8);
    EXPECT_EQ(bytes_at(frame(drawing), 0, 0), (Bytes4{0, 255, 255, 255}));
}

TEST_F(RendererTest, floats_keep_nan_infinities_and_large_and_negative_values) {
    Renderer drawing = renderer(R"(
        void mainImage(out vec4 c, in vec2 p) {
            int x = int(p.x);
            float v = x == 0 ? uintBitsToFloat(0x7fc00000u) : x == 1 ? uintBitsToFloat(0x7f800000u)
                    : x == 2 ? uintBitsToFloat(0xff800000u) : x == 3 ? -3.4e38 : 1e-30;
            c = vec4(v);
        })",
                                {5, 1});
    const Image image = frame(drawing);
    const image::FiniteCensus found = image::census(image);
    EXPECT_EQ(found.nan, 3u);
    EXPECT_EQ(found.positive_infinity, 3u);
    EXPECT_EQ(found.negative_infinity, 3u);
    EXPECT_EQ(floats_at(image, 3, 0)[2], -3.4e38f);
    EXPECT_EQ(floats_at(image, 4, 0)[0], 1e-30f);
    EXPECT_EQ(floats_at(image, 0, 0)[3], 1.0f);
}

TEST_F(RendererTest, resize_changes_target_and_iResolution) {
    Renderer drawing = renderer(
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(iResolution, 0.0) + vec4(p, 0.0, 0.0); }", {4, 3});
    frame(drawing);
    ASSERT_TRUE(drawing.resize({9, 5}));
    EXPECT_EQ(drawing.extent(), (Extent{9, 5}));
    const Image image = frame(drawing);
    EXPECT_EQ(image.extent, (Extent{9, 5}));
    EXPECT_EQ(floats_at(image, 8, 4), (Floats4{17.5f, 9.5f, 1.0f, 1.0f}));
    ASSERT_TRUE(drawing.resize({1, 1}));
    EXPECT_EQ(floats_at(frame(drawing), 0, 0), (Floats4{1.5f, 1.5f, 1.0f, 1.0f}));
}

TEST_F(RendererTest, resized_equals_created_in_that_size) {
    Renderer resized = renderer(k_moving, {16, 16}, SampleType::u8);
    frame(resized, inputs_of_frame(0, 60));
    ASSERT_TRUE(resized.resize({50, 30}));
    Renderer made = renderer(k_moving, {50, 30}, SampleType::u8);
    EXPECT_EQ(frame(resized, inputs_of_frame(3, 60)), frame(made, inputs_of_frame(3, 60)));
}

TEST_F(RendererTest, target_beyond_the_drivers_limit_is_a_usage_error_with_the_limit) {
    const int limit = gl::query_capabilities().largest_target;
    for (const Extent extent : {Extent{limit + 1, 1}, Extent{1, limit + 1}}) {
        const auto made = create(k_places, extent);
        ASSERT_FALSE(made);
        EXPECT_EQ(made.error().code, ErrorCode::usage);
        EXPECT_EQ(made.error().message,
                  fmt::format("--size {}x{}: this driver draws at most {} pixels on a side", extent.width,
                              extent.height, limit));
    }
}

TEST_F(RendererTest, resize_that_fails_leaves_the_old_target) {
    Renderer drawing = renderer(k_places, {4, 4}, SampleType::u8);
    const int limit = gl::query_capabilities().largest_target;
    EXPECT_FALSE(drawing.resize({limit + 1, 4}));
    EXPECT_EQ(drawing.extent(), (Extent{4, 4}));
    EXPECT_EQ(bytes_at(frame(drawing), 3, 2), (Bytes4{3, 2, 51, 255}));
}

TEST_F(RendererTest, two_renderers_do_not_disturb_each_other) {
    Renderer first = diligent_renderer(k_places, {8, 8}, SampleType::u8);
    const Image alone = frame(first);
    Renderer second = renderer(k_moving, {33, 7});
    frame(second, inputs_of_frame(4, 60));
    EXPECT_EQ(frame(first), alone);
}

TEST_F(RendererTest, move_assignment_draws_the_assigned_scene) {
    Renderer running = renderer(k_moving, {8, 8}, SampleType::u8);
    frame(running);
    running = renderer(k_places, {8, 8}, SampleType::u8);
    EXPECT_EQ(bytes_at(frame(running), 5, 6), (Bytes4{5, 6, 51, 255}));
}

TEST_F(RendererTest, draw_is_independent_of_earlier_gl_state) {
    Renderer drawing =
        diligent_renderer("void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p / 256.0); }",
                          {8, 8}, SampleType::u8);
    const Image undisturbed = frame(drawing);
    glViewport(3, 3, 1, 1);
    glUseProgram(0);
    glBindVertexArray(0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBindTextureUnit(0, 0);
    glBindSampler(0, 0);
    glEnable(GL_DITHER);
    glPixelStorei(GL_PACK_ALIGNMENT, 8);
    EXPECT_EQ(frame(drawing), undisturbed);
}

/// The same shader on a bare RGBA8 framebuffer, with nothing of the renderer but its text.
std::vector<uint8_t> drawn_by_hand(const scene::Scene& scene, Extent extent) {
    auto program = gl::Program::link(glsl::k_vertex_shader, glsl::assemble(scene, scene.image()).text());
    EXPECT_TRUE(program) << program.error();
    GLuint colours = 0;
    GLuint framebuffer = 0;
    GLuint vertices = 0;
    glCreateRenderbuffers(1, &colours);
    glNamedRenderbufferStorage(colours, GL_RGBA8, extent.width, extent.height);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours);
    glCreateVertexArrays(1, &vertices);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glBindVertexArray(vertices);
    glViewport(0, 0, extent.width, extent.height);
    glUseProgram(program->id());
    glUniform3f(glGetUniformLocation(program->id(), "iResolution"), float(extent.width), float(extent.height),
                1.0f);
    glUniform1f(glGetUniformLocation(program->id(), "iTime"), 1.25f);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<uint8_t> pixels(extent.pixels() * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, extent.width, extent.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glDeleteVertexArrays(1, &vertices);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &colours);
    return pixels;
}

TEST_F(RendererTest, bytes_equal_a_direct_gl_readback) {
    const scene::Scene scene = scene_of(R"(
        void mainImage(out vec4 c, in vec2 p) {
            vec2 uv = p / iResolution.xy;
            c = vec4(sin(uv.x * 40.0 + iTime), 1.3 * uv.y - 0.1, fract(sin(dot(p, vec2(91.7, 3.1))) * 4311.3), 0.5);
        })");
    Renderer drawing = renderer(scene, {61, 43}, SampleType::u8);
    FrameInputs inputs;
    inputs.time = 1.25;
    const Image image = frame(drawing, inputs);
    EXPECT_TRUE(std::ranges::equal(image.u8(), drawn_by_hand(scene, {61, 43})));
}

TEST_F(RendererTest, compile_error_has_the_authors_file_and_line_through_includes) {
    put("outer.glsl",
        "float outer() { return 1.0; }\n#include \"inner.glsl\"\nfloat last() { return 2.0; }\n");
    put("inner.glsl", "\n\nfloat inner() { return nothing_here; }\n");
    const auto made = create("#include \"outer.glsl\"\n"
                             "void mainImage(out vec4 c, in vec2 p) { c = vec4(nor_here); }\n",
                             {4, 4});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::load);
    EXPECT_EQ(made.error().message, fmt::format("'{}' does not compile", path_of("scene.glsl")));
    std::vector<SourceLocation> places;
    for (const Diagnostic& diagnostic : made.error().diagnostics)
        if (diagnostic.message.find("here") != std::string::npos)
            places.push_back(diagnostic.where);
    EXPECT_EQ(places,
              (std::vector<SourceLocation>{{path_of("inner.glsl"), 3, 24}, {path_of("scene.glsl"), 2, 50}}));
}

TEST_F(RendererTest, linker_errors_are_reported) {
    const auto made = create("float missing(float x);\n"
                             "void mainImage(out vec4 c, in vec2 p) { c = vec4(missing(p.x)); }\n",
                             {4, 4});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::load);
    ASSERT_FALSE(made.error().diagnostics.empty());
    EXPECT_THAT(to_string(made.error()), HasSubstr("missing"));
}

TEST_F(RendererTest, unreadable_picture_is_named_with_its_directive) {
    put("text.png", "hello");
    constexpr const char* k_reads = "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel2, p); }\n";
    for (const auto& [file, why] :
         {std::pair("none.png", "no such file"),
          std::pair("text.png", "it is not a PNG, JPEG, TIFF, EXR, HDR, BMP, WebP, PNM or TGA picture")}) {
        const auto made = create(fmt::format("\n\n#iChannel2 \"{}\"\n{}", file, k_reads), {4, 4});
        ASSERT_FALSE(made);
        EXPECT_EQ(to_string(made.error()), fmt::format("{}:3: error: cannot read '{}': {}",
                                                       path_of("scene.glsl"), path_of(file), why));
    }
}

TEST_F(RendererTest, unread_channel_has_no_texture) {
    const Renderer drawing = renderer(
        "#iChannel0 \"none.png\"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n", {4, 4});
    ASSERT_EQ(drawing.plan().passes.size(), 1u);
    EXPECT_TRUE(drawing.plan().passes[0].channels.empty());
}

} // namespace tidemark::render::renderer_gl_test
