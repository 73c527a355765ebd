// A pass is drawn again only if something that it reads has changed, and the pictures are the same: two
// renderers draw the same frames of one scene, one only the changed passes, the other all of them.
#include "gl_test.hpp"
#include "render/frame_stepper.hpp"
#include "scene/load_scene.hpp"

#include <limits>
#include <random>

namespace tidemark::render::changed_gl_test {

using image::SampleType;

constexpr Extent k_extent{7, 5};

FrameInputs at(int frame) {
    return inputs_of_frame(frame, 60);
}

FrameInputs clicked(FrameInputs inputs, float x, float y) {
    inputs.mouse = {x, y, -x, -y};
    return inputs;
}

class ChangedTest : public RenderTest {
protected:
    /// A project of these files.
    void open(const std::vector<std::pair<std::string, std::string>>& files) {
        for (const auto& [name, text] : files)
            put(name, text);
        auto scene = scene::load_scene(fs::path(path_of("image.glsl")).parent_path());
        ASSERT_TRUE(scene) << to_string(scene.error());
        open_scene(*scene);
    }
    void open_scene(const scene::Scene& scene) {
        auto sparing = Renderer::create(scene, {k_extent, SampleType::f32});
        auto always = Renderer::create(
            scene, {.extent = k_extent, .samples = SampleType::f32, .extras = {.unchanged = true}});
        ASSERT_TRUE(sparing) << to_string(sparing.error());
        ASSERT_TRUE(always) << to_string(always.error());
        sparing_ = *std::move(sparing);
        always_ = *std::move(always);
    }

    /// How many passes the frame needed. All of them show what they show when they are always drawn.
    size_t draw(const FrameInputs& inputs) {
        const size_t before = sparing_->passes_drawn();
        const size_t always_before = always_->passes_drawn();
        sparing_->draw(inputs);
        always_->draw(inputs);
        EXPECT_EQ(always_->passes_drawn() - always_before, always_->plan().passes.size());
        expect_the_same();
        return sparing_->passes_drawn() - before;
    }
    void expect_the_same() {
        for (const PlannedPass& planned : sparing_->plan().passes) {
            const scene::Pass& pass = sparing_->scene().passes[planned.pass];
            const int faces = pass.kind == scene::PassKind::cubemap ? 6 : 1;
            for (int face = 0; face < faces; ++face)
                EXPECT_EQ(sparing_->read_floats(planned.pass, face), always_->read_floats(planned.pass, face))
                    << pass.name << ' ' << face;
        }
    }
    template <class Act>
    void both(Act act) {
        act(*sparing_);
        act(*always_);
    }
    void resize(Extent extent) {
        both([&](Renderer& renderer) { EXPECT_TRUE(renderer.resize(extent)); });
    }
    void turn(double value) {
        both([&](Renderer& renderer) {
            std::vector<scene::Knob> knobs = renderer.scene().knobs;
            knobs.at(0).value[0] = value;
            renderer.turn(std::move(knobs));
        });
    }

    std::optional<Renderer> sparing_;
    std::optional<Renderer> always_;
};

TEST_F(ChangedTest, a_still_picture_is_drawn_once) {
    open({{"image.glsl",
           "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.5, 1.0); }"}});
    EXPECT_EQ(draw(at(0)), 1u);
    EXPECT_EQ(draw(at(1)), 0u);
    EXPECT_EQ(draw(clicked(at(9), 3, 2)), 0u);
    EXPECT_FALSE(sparing_->follows_clock());
}

TEST_F(ChangedTest, each_uniform_redraws_only_its_readers) {
    const std::vector<std::pair<std::string, std::function<void(FrameInputs&)>>> uniforms = {
        {"iTime", [](FrameInputs& inputs) { inputs.time += 1; }},
        {"iTimeDelta", [](FrameInputs& inputs) { inputs.time_delta += 1; }},
        {"float(iFrame)", [](FrameInputs& inputs) { inputs.frame += 1; }},
        {"iFrameRate", [](FrameInputs& inputs) { inputs.frame_rate += 1; }},
        {"iMouse.w", [](FrameInputs& inputs) { inputs.mouse.w += 1; }},
        {"iDate.w", [](FrameInputs& inputs) { inputs.date.seconds += 1; }},
        {"iCamera[3].x", [](FrameInputs& inputs) { inputs.camera[3].x += 1; }},
    };
    for (const auto& [read, unused] : uniforms) {
        const std::string camera = read.starts_with("iCamera") ? "uniform mat4 iCamera;\n" : "";
        open_scene(scene_of(camera + telling({read})));
        FrameInputs inputs = at(3);
        EXPECT_EQ(draw(inputs), 1u) << read;
        for (const auto& [changed, change] : uniforms) {
            change(inputs);
            EXPECT_EQ(draw(inputs), changed == read ? 1u : 0u) << read << " while " << changed << " changes";
        }
    }
}

TEST_F(ChangedTest, clock_uniforms_make_a_scene_follow_the_clock) {
    for (const char* read :
         {"iTime", "iTimeDelta", "float(iFrame)", "iFrameRate", "iDate.w", "iChannelTime[0]"}) {
        open_scene(scene_of(telling({read})));
        EXPECT_TRUE(sparing_->follows_clock()) << read;
    }
    for (const char* name : {"iBeat", "iTimeLow"}) {
        open_scene(scene_of(std::string("uniform float ") + name + ";\n" + telling({name})));
        EXPECT_TRUE(sparing_->follows_clock()) << name;
    }
    for (const char* read : {"iMouse.x", "iResolution.x", "iSampleRate", "texture(iChannel0, p).x"}) {
        open_scene(scene_of(telling({read})));
        EXPECT_FALSE(sparing_->follows_clock()) << read;
    }
}

TEST_F(ChangedTest, knobs_are_compared_bit_by_bit) {
    open_scene(scene_of("#iUniform float knob = 0.5 in { 0.0, 1.0 }\n" + telling({"knob", "1.0 / knob"})));
    EXPECT_EQ(draw(at(0)), 1u);
    turn(0.5);
    EXPECT_EQ(draw(at(1)), 0u);
    for (const double value : {std::nan(""), 0.0, -0.0, std::numeric_limits<double>::infinity()}) {
        turn(value);
        EXPECT_EQ(draw(at(2)), 1u) << value;
        EXPECT_EQ(draw(at(3)), 0u) << value;
    }
}

TEST_F(ChangedTest, a_change_redraws_direct_and_indirect_readers) {
    open({{"buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0.0, 1.0); }"},
          {"buffer_b.glsl", "#iChannel0 \"buffer_a.glsl\"\n"
                            "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p) + iMouse; }"},
          {"image.glsl", "#iChannel0 \"buffer_a.glsl\"\n#iChannel1 \"buffer_b.glsl\"\n"
                         "void mainImage(out vec4 c, in vec2 p) {\n"
                         "    c = texture(iChannel0, p / 9.0) + texture(iChannel1, p / 9.0);\n}\n"}});
    EXPECT_EQ(draw(at(0)), 3u);
    EXPECT_EQ(draw(at(1)), 0u);
    EXPECT_EQ(draw(clicked(at(2), 3, 2)), 2u); // Buffer B and Image
    EXPECT_EQ(draw(clicked(at(3), 3, 2)), 0u);
    resize({9, 4});
    EXPECT_EQ(draw(clicked(at(4), 3, 2)), 3u);
    both([](Renderer& renderer) { renderer.reset(); });
    EXPECT_EQ(draw(clicked(at(0), 3, 2)), 3u);
    EXPECT_EQ(draw(clicked(at(1), 3, 2)), 0u);
}

TEST_F(ChangedTest, a_pass_that_reads_itself_is_always_drawn) {
    open({{"buffer_a.glsl", "#iChannel0 \"self\"\n"
                            "void mainImage(out vec4 c, in vec2 p) {\n"
                            "    c = 0.5 * texelFetch(iChannel0, ivec2(p), 0) + vec4(1.0);\n}\n"},
          {"image.glsl",
           "#iChannel0 \"buffer_a.glsl\"\n"
           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }"}});
    for (int i = 0; i < 40; ++i) // it comes to rest at 2 after 25 frames, which cannot be known before
        EXPECT_EQ(draw(at(i)), 2u);
}

TEST_F(ChangedTest, a_reader_drawn_before_its_source_is_one_frame_late) {
    open({{"buffer_a.glsl",
           "#iChannel0 \"buffer_b.glsl\"\n"
           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }"},
          {"buffer_b.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, iMouse.xy); }"},
          {"image.glsl",
           "#iChannel0 \"buffer_a.glsl\"\n"
           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }"}});
    EXPECT_EQ(draw(at(0)), 3u);
    EXPECT_EQ(draw(at(1)), 2u);
    EXPECT_EQ(draw(at(2)), 0u);
    EXPECT_EQ(draw(clicked(at(3), 1, 1)), 1u);
    EXPECT_EQ(draw(clicked(at(4), 1, 1)), 2u);
    EXPECT_EQ(draw(clicked(at(5), 1, 1)), 0u);
}

TEST_F(ChangedTest, a_cycle_of_passes_is_always_drawn) {
    open({{"buffer_a.glsl",
           "#iChannel0 \"buffer_b.glsl\"\n"
           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }"},
          {"buffer_b.glsl", "#iChannel0 \"buffer_a.glsl\"\n"
                            "void mainImage(out vec4 c, in vec2 p) {\n"
                            "    c = texelFetch(iChannel0, ivec2(p), 0) + 1.0;\n}\n"},
          {"image.glsl",
           "#iChannel0 \"buffer_b.glsl\"\n"
           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }"}});
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(draw(at(i)), 3u);
}

TEST_F(ChangedTest, a_cube_pass_keeps_its_faces_and_mipmaps_through_a_resize) {
    open({{"cube_a.glsl",
           "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(d, 1.0); }"},
          {"image.glsl", "#iChannel0 \"cube_a.glsl\"\n#iChannel0::MinFilter \"LinearMipMapLinear\"\n"
                         "void mainImage(out vec4 c, in vec2 p) {\n"
                         "    c = textureLod(iChannel0, vec3(p - 3.0, 1.0), 5.0);\n}\n"}});
    EXPECT_EQ(draw(at(0)), 2u);
    EXPECT_EQ(draw(at(1)), 0u);
    resize({4, 3});
    EXPECT_EQ(draw(at(2)), 1u);
    both([](Renderer& renderer) { renderer.reset(); });
    EXPECT_EQ(draw(at(3)), 2u);
}

TEST_F(ChangedTest, keys_redraw_only_readers_of_the_keyboard) {
    open({{"image.glsl",
           "#iChannel0 \"keyboard\"\n"
           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(65, 0), 0); }"}});
    FrameInputs inputs = at(0);
    EXPECT_EQ(draw(inputs), 1u);
    EXPECT_EQ(draw(inputs), 0u);
    inputs.keyboard[65] = 255;
    EXPECT_EQ(draw(inputs), 1u);
    EXPECT_EQ(draw(inputs), 0u);
    inputs.keyboard[65] = 0;
    EXPECT_EQ(draw(inputs), 1u);
    EXPECT_FALSE(sparing_->follows_clock());
}

TEST_F(ChangedTest, music_redraws_as_time_advances) {
    scene::Scene scene =
        scene_of("void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }");
    scene.passes[0].channels[0].input = scene::Music{};
    open_scene(scene);
    EXPECT_TRUE(sparing_->follows_clock());
    EXPECT_EQ(draw(at(0)), 1u);
    EXPECT_EQ(draw(at(0)), 0u);
    EXPECT_EQ(draw(at(7)), 1u);
}

TEST_F(ChangedTest, discarded_pixels_keep_their_value) {
    open_scene(scene_of("void mainImage(out vec4 c, in vec2 p) {\n"
                        "    if (p.x < iMouse.x) discard;\n    c = vec4(p, iMouse.y, 1.0);\n}\n"));
    for (const float x : {0.0f, 3.0f, 3.0f, 1.0f, 5.0f, 5.0f})
        draw(clicked(at(0), x, x));
}

/// The two textures of a buffer take turns: what is discarded shows the frame before the last.
TEST_F(ChangedTest, a_buffer_that_discards_keeps_pixels_as_shadertoy_does) {
    open({{"buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) {\n"
                            "    if (p.x < iMouse.x) discard;\n    c = vec4(iMouse.y);\n}\n"},
          {"image.glsl",
           "#iChannel0 \"buffer_a.glsl\"\n"
           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }\n"}});
    EXPECT_TRUE(sparing_->plan().feedback);
    const auto shown = [&](float x, float y) {
        draw(clicked(at(0), x, y));
        return floats_at(sparing_->read_floats(0), 0, 0)[0];
    };
    EXPECT_EQ(shown(0, 1), 1);
    EXPECT_EQ(shown(9, 2), 0);
    EXPECT_EQ(shown(9, 2), 1);
    EXPECT_EQ(shown(0, 3), 3);
    EXPECT_EQ(shown(9, 3), 1);
    EXPECT_EQ(shown(9, 3), 3);
}

TEST_F(ChangedTest, warming_up_changes_no_target) {
    open_scene(scene_of("void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 1.0, 1.0); }"));
    both([](Renderer& renderer) { renderer.warm_up(at(0)); });
    EXPECT_EQ(draw(at(0)), 1u);
    both([](Renderer& renderer) { renderer.warm_up(at(0)); });
    EXPECT_EQ(draw(at(0)), 1u);
}

TEST_F(ChangedTest, passes_before_a_preview_are_drawn_if_changed) {
    open({{"buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, iMouse.xy); }"},
          {"image.glsl",
           "#iChannel0 \"buffer_a.glsl\"\n"
           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }"}});
    const size_t image = sparing_->shown_index();
    both([&](Renderer& renderer) { (void)PassPreview(renderer, image, at(0)); });
    EXPECT_EQ(sparing_->passes_drawn(), 1u);
    expect_the_same();
    auto target = gl::make_render_target(gl::make_texture(k_extent, GL_RGBA32F, 1));
    ASSERT_TRUE(target);
    PassPreview(*sparing_, image, at(0)).draw(sparing_->program(image), *target);
    EXPECT_EQ(draw(at(0)), 1u); // Image itself was not drawn yet
    EXPECT_EQ(draw(at(1)), 0u);
}

TEST_F(ChangedTest, a_renderer_of_a_changed_scene_keeps_the_buffers) {
    const auto count = [&](const char* step) {
        open({{"buffer_a.glsl",
               fmt::format("#iChannel0 \"self\"\nvoid mainImage(out vec4 c, in vec2 p) {{\n"
                           "    c = texelFetch(iChannel0, ivec2(p), 0) + vec4(p, {}, 0.0);\n}}\n",
                           step)},
              {"cube_a.glsl", "#iChannel0 \"self\"\n"
                              "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) {\n"
                              "    c = texture(iChannel0, d) + 1.0;\n}\n"},
              {"image.glsl",
               "#iChannel0 \"buffer_a.glsl\"\n#iChannel1 \"cube_a.glsl\"\n"
               "void mainImage(out vec4 c, in vec2 p) {\n"
               "    c = texelFetch(iChannel0, ivec2(p), 0) + texture(iChannel1, vec3(0, 0, 1));\n}\n"}});
    };
    count("1.0");
    for (int i = 0; i < 3; ++i)
        draw(at(i));
    const std::optional<Renderer> before = std::move(sparing_);
    count("10.0");
    both([&](Renderer& renderer) {
        EXPECT_TRUE(renderer.resize({k_extent.width + 2, k_extent.height - 1}));
        renderer.continue_from(*before);
    });
    draw(at(3));
    const size_t buffer = sparing_->plan().passes[0].pass;
    const image::Image drawn = sparing_->read_floats(buffer);
    EXPECT_EQ(floats_at(drawn, 6, 3), (Floats4{4 * 6.5f, 4 * 3.5f, 13, 0}));
    EXPECT_EQ(floats_at(drawn, 7, 3), (Floats4{7.5f, 3.5f, 10, 0})) << "there was nothing";
    for (int face = 0; face < 6; ++face)
        EXPECT_EQ(floats_at(sparing_->read_floats(sparing_->plan().passes[1].pass, face), 9, 9)[0], 4)
            << face;
}

/// Everything at once, in any order.
TEST_F(ChangedTest, skipping_unchanged_passes_keeps_the_pictures) {
    open({{"common.glsl", "vec4 at(sampler2D s, vec2 p) { return texelFetch(s, ivec2(p), 0); }\n"},
          {"buffer_a.glsl", "#iChannel0 \"buffer_c.glsl\"\n#iUniform float knob = 0.5 in { 0.0, 1.0 }\n"
                            "void mainImage(out vec4 c, in vec2 p) { c = at(iChannel0, p) + knob; }"},
          {"buffer_b.glsl", "#iChannel0 \"self\"\n#iChannel1 \"buffer_a.glsl\"\n"
                            "#iChannel1::MinFilter \"LinearMipMapLinear\"\n"
                            "void mainImage(out vec4 c, in vec2 p) {\n"
                            "    c = 0.5 * at(iChannel0, p) + textureLod(iChannel1, p / 5.0, 1.5);\n}\n"},
          {"buffer_c.glsl", "#iChannel0 \"keyboard\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                            "    c = vec4(p, texelFetch(iChannel0, ivec2(65, 0), 0).x, iMouse.x);\n}\n"},
          {"buffer_d.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(floor(iTime), p, 1.0); }"},
          {"image.glsl",
           "#iChannel0 \"buffer_a.glsl\"\n#iChannel1 \"buffer_b.glsl\"\n"
           "#iChannel2 \"buffer_c.glsl\"\n#iChannel3 \"buffer_d.glsl\"\n"
           "void mainImage(out vec4 c, in vec2 p) {\n    if (p.y < iMouse.y) discard;\n"
           "    c = at(iChannel0, p) - 0.1 * at(iChannel1, p) + at(iChannel2, p) * at(iChannel3, p);\n}\n"}});
    std::mt19937 random(20261121);
    const auto chance = [&](int one_in) { return random() % unsigned(one_in) == 0; };
    const auto some = [&](int below) { return float(random() % unsigned(below)); };
    FrameInputs inputs;
    size_t drawn = 0;
    constexpr int k_frames = 200;
    for (int i = 0; i < k_frames && !HasFailure(); ++i) {
        inputs.frame = i;
        inputs.time = i / 10.0;
        if (chance(9))
            inputs.mouse = {some(7), some(5), some(2), some(2)};
        if (chance(10))
            inputs.keyboard[65] ^= 255;
        if (chance(11))
            turn(chance(4) ? std::nan("") : some(3));
        if (chance(20))
            resize({3 + int(some(6)), 2 + int(some(6))});
        if (chance(30))
            both([](Renderer& renderer) { renderer.reset(); });
        drawn += draw(inputs);
    }
    EXPECT_GE(drawn, size_t{k_frames}) << "Buffer B reads itself";
    EXPECT_LT(drawn, sparing_->plan().passes.size() * k_frames * 4 / 5) << "something rested";
}

} // namespace tidemark::render::changed_gl_test
