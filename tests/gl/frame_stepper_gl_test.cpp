// A frame of a scene with feedback is the same whatever was drawn before it.
#include "gl_test.hpp"
#include "render/frame_stepper.hpp"

namespace tidemark::render::frame_stepper_gl_test {

class FrameStepperTest : public RenderTest {
protected:
    /// Its Image counts the frames that were drawn, and tells the time.
    Renderer counting() const {
        put("buffer_a.glsl",
            "#iChannel0 \"self\"\n"
            "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }");
        const auto image =
            put("image.glsl", "#iChannel0 \"buffer_a.glsl\"\n"
                              "void mainImage(out vec4 c, in vec2 p) {\n"
                              "    c = vec4(texelFetch(iChannel0, ivec2(p), 0).r, iTime, 0.0, 1.0);\n}");
        const auto scene = scene::load_scene(image.parent_path());
        EXPECT_TRUE(scene) << to_string(scene.error());
        return renderer(*scene, {2, 2});
    }
    static float count(const Renderer& drawn) { return floats_at(drawn.read_back(), 0, 0)[0]; }
};

TEST_F(FrameStepperTest, a_frame_is_reached_by_all_earlier_frames) {
    Renderer drawing = counting();
    FrameStepper stepper(drawing, FrameState{});
    EXPECT_EQ(stepper.draw(3).frames, 4);
    EXPECT_EQ(count(drawing), 4);
    EXPECT_EQ(stepper.draw(5).frames, 2) << "it goes on";
    EXPECT_EQ(count(drawing), 6);
    EXPECT_EQ(stepper.draw(1).frames, 2) << "from the start";
    EXPECT_EQ(count(drawing), 2);
    const FrameSteps steps = FrameStepper(drawing, FrameState{}, 7).draw(9);
    EXPECT_EQ(steps.frames, 3);
    EXPECT_EQ(steps.passes, 6u);
    EXPECT_EQ(count(drawing), 3);
}

TEST_F(FrameStepperTest, earlier_frames_have_earlier_times) {
    Renderer drawing = counting();
    const FrameState state = at_time(0.99);
    std::vector<float> times;
    FrameStepper stepper(drawing, state, state.frame - 2);
    for (int frame = state.frame - 2; frame <= state.frame; ++frame) {
        stepper.draw(frame);
        times.push_back(floats_at(drawing.read_back(), 0, 0)[1]);
    }
    EXPECT_EQ(times, (std::vector<float>{float(0.99 - 2 / 60.0), float(0.99 - 1 / 60.0), 0.99F}));
}

TEST_F(FrameStepperTest, stepping_stops_between_frames) {
    Renderer drawing = counting();
    const FrameSteps steps = FrameStepper(drawing, FrameState{}).draw(9, [](int frame, int last) {
        return last == 9 && frame < 2;
    });
    EXPECT_FALSE(steps.complete);
    EXPECT_EQ(steps.frames, 2);
}

TEST_F(FrameStepperTest, a_preview_leaves_the_buffers_unchanged) {
    Renderer drawing = counting();
    FrameStepper stepper(drawing, FrameState{});
    {
        const PassPreview preview = stepper.preview(3, drawing.shown_index());
        EXPECT_EQ(floats_at(drawing.read_floats(0), 0, 0)[0], 4) << "the buffer has made its step";
    }
    EXPECT_EQ(floats_at(drawing.read_floats(0), 0, 0)[0], 0);
    EXPECT_EQ(stepper.draw(3).frames, 4);
    EXPECT_EQ(count(drawing), 4);
}

TEST_F(FrameStepperTest, scenes_without_feedback_draw_one_frame) {
    Renderer drawing = renderer("void mainImage(out vec4 c, in vec2 p) { c = vec4(iFrame); }", {2, 2});
    EXPECT_EQ(FrameStepper(drawing, FrameState{}).draw(100).frames, 1);
    EXPECT_EQ(count(drawing), 100);
}

} // namespace tidemark::render::frame_stepper_gl_test
