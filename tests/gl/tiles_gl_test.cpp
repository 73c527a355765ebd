// A picture drawn in tiles is the picture drawn whole, byte for byte.
#include "gl_test.hpp"
#include "render/exposure.hpp"
#include "scene/load_scene.hpp"
#include "shader/shader_source.hpp"

#include <gmock/gmock.h>

namespace tidemark::render::tiles_gl_test {

using image::Image;
using image::SampleType;

struct Case {
    SampleType samples = SampleType::f32;
    glsl::Precision precision = glsl::Precision::single;
    std::string pass{};
    int frame = 0;
};

class TilesTest : public RenderTest {
protected:
    static Renderer make(const scene::Scene& scene, Extent extent, std::optional<Extent> tile,
                         const Case& what) {
        auto made = Renderer::create(scene, {.extent = extent,
                                             .samples = what.samples,
                                             .pass = what.pass,
                                             .precision = what.precision,
                                             .tile = tile});
        EXPECT_TRUE(made) << to_string(made.error());
        return *std::move(made);
    }
    static void draw_up_to(Renderer& renderer, int frame) {
        for (int i = renderer.plan().feedback ? 0 : frame; i <= frame; ++i)
            renderer.draw(inputs_of_frame(i, 60));
    }
    static void expect_same(const scene::Scene& scene, Extent extent, Extent tile, const Case& what = {}) {
        Renderer whole = make(scene, extent, std::nullopt, what);
        draw_up_to(whole, what.frame);
        const Image expected = whole.read_back();
        Renderer cut = make(scene, extent, tile, what);
        ASSERT_TRUE(cut.tiles());
        cut.warm_up(inputs_of_frame(what.frame, 60));
        draw_up_to(cut, what.frame);
        const Image actual = draw_in_tiles(cut, inputs_of_frame(what.frame, 60));
        size_t different = 0;
        for (size_t i = 0; i < expected.bytes.size(); ++i)
            different += expected.bytes[i] != actual.bytes[i];
        // Mesa 25 reads the levels of a texture a little otherwise in each tile (not with LP_PERF=no_mipmap):
        // at most two bytes in a hundred, by less than shows (the probe `tiles`).
        const std::string version(reinterpret_cast<const char*>(glGetString(GL_VERSION)));
        EXPECT_LE(different, version.find("Mesa 22.") != version.npos ? 0 : expected.bytes.size() / 50)
            << extent.width << 'x' << extent.height << " in tiles of " << tile.width << 'x' << tile.height;
        EXPECT_EQ(actual.extent, expected.extent);
    }
    static scene::Scene shader(const std::string& name) {
        auto scene = scene::load_scene(fs::path(TIDEMARK_SOURCE_DIR) / "shaders" / name);
        EXPECT_TRUE(scene) << to_string(scene.error());
        return *std::move(scene);
    }
};

/// Coordinates by each of their names, derivatives of what is not linear, and a mipmap chosen by a curve.
constexpr const char* k_seams = R"(
#define AT gl_FragCoord
float bend(vec2 p) { return sin(p.x * 0.37) * cos(p.y * 0.21) + length(gl_FragCoord.xy - p * 0.5); }
void mainImage(out vec4 c, in vec2 p) {
    float f = bend(p);
    vec2 uv = (p - 0.5 * iResolution.xy) / iResolution.y;
    float shade = fwidth(f) + dFdx(f * f) - dFdy(AT.x * AT.y);
    if (mod(AT.x + AT.y, 7.0) < 3.0)
        shade += texture(iChannel0, uv * uv * 3.0).r;
    c = vec4(shade, texture(iChannel0, uv / dot(uv, uv)).g, AT.z + AT.w + p.y, 1.0);
}
)";

TEST_F(TilesTest, tiles_of_any_size_leave_no_seams) {
    const scene::Scene scene = scene_of(k_seams);
    for (const Extent extent : {Extent{1, 1}, {64, 64}, {97, 61}, {130, 33}, {5, 200}})
        for (const Extent tile : {Extent{2, 2}, {6, 10}, {64, 16}, {256, 256}})
            expect_same(scene, extent, tile);
}

TEST_F(TilesTest, bytes_and_doubles_have_no_seams) {
    expect_same(scene_of(k_seams), {97, 61}, {16, 16}, {SampleType::u8});
    expect_same(scene_of(k_seams), {97, 61}, {16, 16}, {SampleType::f32, glsl::Precision::promoted});
}

TEST_F(TilesTest, pixels_far_from_the_corner_have_exact_coordinates) {
    // Floats have one bit after the point there, which the centres of pixels need.
    auto made = Renderer::create(scene_of("void mainImage(out vec4 c, in vec2 p) {\n"
                                          "    vec3 digits = floor(p.x / vec3(65536.0, 256.0, 1.0));\n"
                                          "    if (p == gl_FragCoord.xy && fract(p) == vec2(0.5))\n"
                                          "        c.rgb = mod(digits, 256.0) / 255.0;\n}\n"),
                                 {.extent = {k_largest_tiled_side, 2}, .tile = Extent{4, 2}});
    ASSERT_TRUE(made) << to_string(made.error());
    Image band(made->extent(), 4, SampleType::u8);
    const TileGrid grid = *made->tiles();
    made->draw(FrameInputs{});
    made->draw_tile({}, grid.at(grid.columns() - 1, 0), band);
    EXPECT_EQ(bytes_at(band, k_largest_tiled_side - 1, 1), (Bytes4{0x7f, 0xff, 0xff, 255}));
    EXPECT_EQ(bytes_at(band, k_largest_tiled_side - 4, 0), (Bytes4{0x7f, 0xff, 0xfc, 255}));
}

TEST_F(TilesTest, shipped_scenes_have_no_seams) {
    for (const char* name : {"water_surface.glsl", "pseudo3d_water.glsl", "procedural_ocean.glsl",
                             "gerstner_waves.glsl", "stylized_waves.glsl"}) {
        SCOPED_TRACE(name);
        expect_same(shader(name), {161, 91}, {32, 16}, {.frame = 100});
    }
}

TEST_F(TilesTest, a_picture_that_keeps_pixels_of_the_frame_before_is_drawn_whole) {
    const auto tiled = [&](const char* statement) {
        const std::string text = "void mainImage(out vec4 c, in vec2 p) { " + std::string(statement) +
                                 " c = vec4(p / iResolution.xy, 1.0, 1.0); }\n";
        return make(scene_of(text), {40, 30}, Extent{8, 8}, {}).tiles().has_value();
    };
    EXPECT_FALSE(tiled("if (p.x < 3.0 && iFrame > 0) discard;"));
    EXPECT_TRUE(tiled("// discard;\n"));
}

TEST_F(TilesTest, buffers_stay_whole_and_keep_their_frames) {
    put("buffer_a.glsl",
        "#iChannel0 \"self\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
        "    vec2 uv = p / iResolution.xy;\n"
        "    c = texture(iChannel0, uv * 0.9 + 0.07) * 0.8 + vec4(uv, fract(iTime), 1.0);\n}\n");
    const scene::Scene scene =
        scene_of("#iChannel0 \"buffer_a.glsl\"\n#iChannel0::MinFilter \"LinearMipMapLinear\"\n"
                 "void mainImage(out vec4 c, in vec2 p) {\n"
                 "    c = texture(iChannel0, p.yx / iResolution.xy * 2.3) + texelFetch(iChannel0, ivec2(1, "
                 "2), 0);\n}\n");
    expect_same(scene, {75, 41}, {16, 8}, {.frame = 5});
}

TEST_F(TilesTest, a_pass_with_readers_is_drawn_whole) {
    put("buffer_a.glsl", "#iChannel0 \"self\"\nvoid mainImage(out vec4 c, in vec2 p) {"
                         " c = texelFetch(iChannel0, ivec2(p), 0) + 0.1; }\n");
    const scene::Scene scene =
        scene_of("#iChannel0 \"buffer_a.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) {"
                 " c = texelFetch(iChannel0, ivec2(p), 0); }\n");
    Case what;
    EXPECT_TRUE(make(scene, {9, 9}, Extent{4, 4}, what).tiles());
    EXPECT_FALSE(make(scene, {9, 9}, std::nullopt, what).tiles());
    what.pass = scene.passes.front().name;
    EXPECT_FALSE(make(scene, {9, 9}, Extent{4, 4}, what).tiles());
    const auto refused = Renderer::create(scene, {.extent = {1 << 20, 2}, .tile = Extent{64, 2}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
    EXPECT_THAT(
        refused.error().message,
        testing::EndsWith(fmt::format(
            "{} cannot be drawn in tiles, because a pass reads it or it discards pixels", what.pass)));
}

TEST_F(TilesTest, every_glsl_version_applies_the_tile_offset) {
    const scene::Scene scene = scene_of(k_seams);
    for (const auto version : {glsl::Version::core_330, glsl::Version::core_450, glsl::Version::es_300}) {
        glsl::Dialect dialect;
        dialect.version = version;
        dialect.tiled = true;
        const auto program = gl::Program::link(glsl::vertex_shader(version),
                                               glsl::assemble(scene, scene.image(), dialect).text());
        ASSERT_TRUE(program) << to_string(dialect) << ": " << program.error();
        EXPECT_TRUE(program->reflection().has("tidemark_tile")) << to_string(dialect);
    }
}

TEST_F(TilesTest, the_authors_main_and_a_macro_entry_point_have_no_seams) {
    for (const char* text :
         {"void main() { gl_FragColor = vec4(gl_FragCoord.xy / iResolution.xy, 0.5, 1.0); }",
          "#define entry mainImage\nvoid entry(out vec4 c, in vec2 p) { c = vec4(p, gl_FragCoord.yx); }"})
        expect_same(scene_of(text), {33, 21}, {8, 8});
}

} // namespace tidemark::render::tiles_gl_test
