// A frame drawn in parts is the frame drawn whole, byte for byte, and one that is given up leaves no trace.
#include "gl_test.hpp"
#include "render/frame_in_parts.hpp"

#include <functional>

namespace tidemark::render::frame_in_parts_gl_test {

constexpr Extent k_extent{97, 61};

/// A clock that goes on with each look: a draw of 0 seconds is one part, and parts stay small.
FrameInParts::Clock ticking() {
    return [now = 0.0]() mutable { return now += 0.004; };
}

class FrameInPartsTest : public RenderTest {
protected:
    static FrameInParts begin(Renderer& renderer, PartSize& size, int frame) {
        return {renderer, inputs_of_frame(frame, 60), size, ticking()};
    }
    /// One part, drawn to its end.
    static Result<bool> step(FrameInParts& frame) {
        auto whole = frame.draw_for(0);
        glFinish();
        return whole;
    }
    /// How many calls that took.
    static int draw_in_parts(Renderer& renderer, PartSize& size, int frame) {
        FrameInParts parts = begin(renderer, size, frame);
        int calls = 1;
        for (; true; ++calls) {
            const auto whole = step(parts);
            EXPECT_TRUE(whole) << to_string(whole.error());
            if (!whole || *whole)
                return calls;
        }
    }
    /// All that it holds, mipmaps too.
    static std::vector<std::vector<float>> content(const Renderer& renderer) {
        std::vector<std::vector<float>> levels;
        for (const PlannedPass& planned : renderer.plan().passes) {
            const gl::Texture& texture = renderer.target_of(planned.pass).texture;
            for (int level = 0; level < texture.levels; ++level)
                levels.push_back(gl::read_level(texture, level));
        }
        for (const PassState& pass : renderer.buffer_state())
            levels.insert(levels.end(), pass.textures.begin(), pass.textures.end());
        return levels;
    }
    static void expect_same(const scene::Scene& scene, const std::string& shown = {}) {
        const RenderOptions options{k_extent, image::SampleType::f32, shown};
        auto whole = Renderer::create(scene, options);
        auto parted = Renderer::create(scene, options);
        ASSERT_TRUE(whole && parted);
        PartSize size;
        for (int frame = 0; frame < 4; ++frame) {
            whole->draw(inputs_of_frame(frame, 60));
            EXPECT_GT(draw_in_parts(*parted, size, frame), 3) << "else there was nothing to test";
            EXPECT_TRUE(content(*parted) == content(*whole)) << "frame " << frame;
            EXPECT_EQ(parted->passes_drawn(), whole->passes_drawn());
            EXPECT_EQ(parted->work().draws, whole->work().draws);
        }
    }
    /// Three buffers that read each other, themselves and what comes after them.
    scene::Scene feedback() const {
        put("common.glsl", "vec4 old(sampler2D s, vec2 p) { return texelFetch(s, ivec2(p), 0); }\n");
        put("buffer_a.glsl",
            "#iChannel0 \"self\"\n#iChannel1 \"buffer_b.glsl\"\n"
            "void mainImage(out vec4 c, in vec2 p) {\n"
            "    c = 0.5 * old(iChannel0, p) + old(iChannel1, p.yx * 0.5) + vec4(p, iTime, 1);\n}");
        put("buffer_b.glsl", "#iChannel0 \"buffer_a.glsl\"\n"
                             "void mainImage(out vec4 c, in vec2 p) {\n"
                             "    c = 0.3 * old(iChannel0, p) + dFdx(p.x * p.x) + dFdy(p.x * p.y);\n}");
        const auto image =
            put("image.glsl", "#iChannel0 \"buffer_a.glsl\"\n#iChannel1 \"buffer_b.glsl\"\n"
                              "#iChannel2 \"self\"\n"
                              "void mainImage(out vec4 c, in vec2 p) {\n"
                              "    c = old(iChannel0, p) - old(iChannel1, p) + 0.25 * old(iChannel2, p);\n}");
        return loaded(image.parent_path());
    }
    static scene::Scene loaded(const fs::path& path) {
        const auto scene = scene::load_scene(path);
        EXPECT_TRUE(scene) << to_string(scene.error());
        return scene.value_or(scene::Scene{});
    }
};

TEST_F(FrameInPartsTest, buffers_that_read_each_other) {
    expect_same(feedback());
}

TEST_F(FrameInPartsTest, a_buffer_on_show) {
    expect_same(feedback(), "Buffer A");
}

TEST_F(FrameInPartsTest, mipmaps_of_buffers) {
    put("buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(p / 7.0 + iTime), 0, 1); }");
    const auto image =
        put("image.glsl", "#iChannel0 \"buffer_a.glsl\"\n#iChannel0::MinFilter \"LinearMipMapLinear\"\n"
                          "void mainImage(out vec4 c, in vec2 p) {\n"
                          "    c = textureLod(iChannel0, p / iResolution.xy, 2.5);\n}");
    const scene::Scene scene = loaded(image.parent_path());
    EXPECT_GT(renderer(scene, k_extent).target_of(0).texture.levels, 1) << "else there is nothing to test";
    expect_same(scene);
}

TEST_F(FrameInPartsTest, a_cube) {
    put("cube_a.glsl",
        "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(d * iTime, p.x); }");
    const auto image =
        put("image.glsl", "#iChannel0 \"cube_a.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                          "    c = texture(iChannel0, vec3(p / iResolution.xy - 0.5, 0.4));\n}");
    expect_same(loaded(image.parent_path()));
}

TEST_F(FrameInPartsTest, pixels_that_are_discarded) {
    expect_same(
        scene_of("void mainImage(out vec4 c, in vec2 p) {\n"
                 "    if (mod(p.x + float(iFrame), 3.0) < 1.0) discard;\n    c = vec4(p, iFrame, 1);\n}"));
    put("buffer_a.glsl",
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    if (mod(p.x + float(iFrame), 3.0) < 1.0) discard;\n    c = vec4(p, iFrame, 1);\n}");
    const auto image =
        put("image.glsl", "#iChannel0 \"buffer_a.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                          "    c = texelFetch(iChannel0, ivec2(p), 0);\n}");
    expect_same(loaded(image.parent_path()));
}

TEST_F(FrameInPartsTest, an_unfinished_frame_leaves_the_last_frame_visible) {
    Renderer drawn = renderer(feedback(), k_extent);
    drawn.draw(inputs_of_frame(0, 60));
    const auto before = content(drawn);
    PartSize size;
    FrameInParts parts = begin(drawn, size, 1);
    double share = parts.share();
    EXPECT_EQ(share, 0);
    int calls = 0;
    while (!*step(parts)) {
        EXPECT_TRUE(content(drawn) == before);
        EXPECT_GE(parts.share(), share);
        share = parts.share();
        ++calls;
    }
    EXPECT_GT(calls, 5);
    EXPECT_FALSE(content(drawn) == before);
    EXPECT_EQ(parts.share(), 1);
    EXPECT_TRUE(*step(parts)) << "it stays whole";
    EXPECT_EQ(drawn.passes_drawn(), 2 * drawn.plan().passes.size());
}

TEST_F(FrameInPartsTest, a_cancelled_frame_leaves_no_trace) {
    const scene::Scene scene = feedback();
    Renderer whole = renderer(scene, k_extent);
    for (int frame = 0; frame < 3; ++frame)
        whole.draw(inputs_of_frame(frame, 60));
    for (int calls = 0; calls < 40; calls += 3) {
        Renderer drawn = renderer(scene, k_extent);
        drawn.draw(inputs_of_frame(0, 60));
        drawn.draw(inputs_of_frame(1, 60));
        const auto before = content(drawn);
        PartSize size;
        {
            FrameInParts parts = begin(drawn, size, 7);
            for (int call = 0; call < calls; ++call)
                if (*step(parts))
                    break;
            if (parts.share() == 1)
                break;
            (void)FrameInParts::give_up(std::move(parts));
        }
        EXPECT_TRUE(content(drawn) == before) << calls;
        EXPECT_EQ(drawn.passes_drawn(), 2 * drawn.plan().passes.size());
        drawn.draw(inputs_of_frame(2, 60));
        EXPECT_TRUE(content(drawn) == content(whole)) << calls;
    }
}

TEST_F(FrameInPartsTest, a_pass_with_unchanged_inputs_is_not_redrawn) {
    put("buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0, 1); }");
    const auto image =
        put("image.glsl", "#iChannel0 \"buffer_a.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                          "    c = texelFetch(iChannel0, ivec2(p), 0) * iTime;\n}");
    Renderer drawn = renderer(loaded(image.parent_path()), k_extent);
    PartSize size;
    draw_in_parts(drawn, size, 0);
    EXPECT_EQ(drawn.passes_drawn(), 2u);
    draw_in_parts(drawn, size, 1);
    EXPECT_EQ(drawn.passes_drawn(), 3u);
    draw_in_parts(drawn, size, 1);
    EXPECT_EQ(drawn.passes_drawn(), 3u);
    drawn.draw(inputs_of_frame(1, 60));
    EXPECT_EQ(drawn.passes_drawn(), 3u) << "nor whole";
}

TEST_F(FrameInPartsTest, changes_of_the_renderer_restart_the_frame) {
    const scene::Scene scene = feedback();
    for (const auto& change :
         std::vector<std::function<void(Renderer&)>>{[](Renderer& r) { r.reset(); },
                                                     [](Renderer& r) {
                                                         EXPECT_TRUE(r.resize({40, 88}));
                                                     },
                                                     [](Renderer& r) { r.draw(inputs_of_frame(5, 60)); }}) {
        Renderer whole = renderer(scene, k_extent);
        Renderer drawn = renderer(scene, k_extent);
        PartSize size;
        for (Renderer* each : {&whole, &drawn})
            each->draw(inputs_of_frame(0, 60));
        FrameInParts parts = begin(drawn, size, 1);
        for (int call = 0; call < 12; ++call)
            ASSERT_FALSE(*step(parts));
        change(whole);
        change(drawn);
        whole.draw(inputs_of_frame(1, 60));
        while (!*step(parts)) {
        }
        EXPECT_TRUE(content(drawn) == content(whole));
    }
}

TEST_F(FrameInPartsTest, each_pass_keeps_one_extra_texture_while_drawn_in_parts) {
    const scene::Scene scene = scene_of("void mainImage(out vec4 c, in vec2 p) { c = vec4(p, iFrame, 1); }");
    Renderer drawn = renderer(scene, k_extent);
    const size_t picture = gl::bytes_of(drawn.target_of(0).texture);
    const size_t bytes = drawn.work().texture_bytes;
    PartSize size;
    for (int frame = 0; frame < 3; ++frame) {
        draw_in_parts(drawn, size, frame);
        EXPECT_EQ(drawn.work().texture_bytes, bytes + picture);
    }
    drawn.draw(inputs_of_frame(3, 60));
    EXPECT_EQ(drawn.work().texture_bytes, bytes);
}

TEST_F(FrameInPartsTest, reports_the_time_of_each_pass) {
    Renderer drawn = renderer(feedback(), k_extent);
    PartSize size;
    FrameInParts parts = begin(drawn, size, 0);
    while (!*step(parts)) {
    }
    std::vector<size_t> planned;
    for (const PlannedPass& pass : drawn.plan().passes)
        planned.push_back(pass.pass);
    std::vector<size_t> passes;
    for (const auto& [pass, seconds] : parts.seconds()) {
        passes.push_back(pass);
        EXPECT_GT(seconds, 0);
    }
    EXPECT_EQ(passes, planned);
}

} // namespace tidemark::render::frame_in_parts_gl_test
