#include "gl_test.hpp"
#include "render/frame_state.hpp"
#include "scene/scene.hpp"

#include <gmock/gmock.h>

namespace tidemark::render::uniform_gl_test {

using testing::ElementsAre;
using testing::ElementsAreArray;
using Values = std::vector<float>;

using UniformTest = RenderTest;

FrameInputs unusual_inputs() {
    FrameInputs inputs;
    inputs.frame = 16777215; // the largest below which every int is a float
    inputs.time = 12345.678901;
    inputs.time_delta = 1 / 24.0;
    inputs.frame_rate = 23.976;
    inputs.mouse = {319, 17, -200, 0};
    inputs.date = {2023, 11, 31, 86399.875};
    return inputs;
}

TEST_F(UniformTest, every_uniform_of_shadertoy_has_its_value) {
    EXPECT_THAT(told({"iResolution.x", "iResolution.y", "iResolution.z", "iTime", "iTimeDelta", "iFrameRate",
                      "float(iFrame)", "iSampleRate"},
                     unusual_inputs(), {}, {48, 3}),
                ElementsAre(48.0f, 3.0f, 1.0f, 12345.678901f, 1 / 24.0f, 23.976f, 16777215.0f, 44100.0f));
    EXPECT_THAT(told({"iMouse.x", "iMouse.y", "iMouse.z", "iMouse.w"}, unusual_inputs()),
                ElementsAre(319.0f, 17.0f, -200.0f, 0.0f));
    EXPECT_THAT(told({"iDate.x", "iDate.y", "iDate.z", "iDate.w"}, unusual_inputs()),
                ElementsAre(2023.0f, 11.0f, 31.0f, 86399.875f));
    EXPECT_THAT(
        told({"iChannelTime[0]", "iChannelTime[1]", "iChannelTime[2]", "iChannelTime[3]"}, unusual_inputs()),
        ElementsAre(0.0f, 0.0f, 0.0f, 0.0f));
}

TEST_F(UniformTest, iFrame_is_a_whole_number) {
    FrameInputs inputs;
    inputs.frame = 2147483647;
    EXPECT_THAT(told({"float(iFrame & 0xffff)", "float(iFrame >> 16)"}, inputs),
                ElementsAre(65535.0f, 32767.0f));
}

TEST_F(UniformTest, iTime_is_computed_in_double) {
    for (const int frame : {1, 7, 1000003, 16777217, 100000000})
        for (const double fps : {24.0, 29.97, 60.0})
            EXPECT_THAT(told({"iTime"}, inputs_of_frame(frame, fps)), ElementsAre(float(double(frame) / fps)))
                << frame << " at " << fps;
}

TEST_F(UniformTest, iTimeLow_is_the_rounding_error_of_iTime) {
    FrameInputs inputs;
    for (const double time : {0.0, 0.1, 59.983333333333334, 1e6 + 1.0 / 3, -5.1}) {
        inputs.time = time;
        const std::vector<float> halves = told({"iTime", "iTimeLow"}, inputs, "uniform float iTimeLow;");
        EXPECT_EQ(halves[0], float(time));
        EXPECT_NEAR(double(halves[0]) + double(halves[1]), time, 1e-14 * std::abs(time));
    }
}

TEST_F(UniformTest, untouched_mouse_is_zero_bit_by_bit) {
    FrameInputs inputs;
    inputs.mouse = Mouse().uniform();
    Mouse corner;
    corner.press(0, 0);
    corner.frame_drawn();
    corner.release();
    FrameInputs clicked;
    clicked.mouse = corner.uniform();
    const std::vector<std::string> bits = {"float(floatBitsToUint(iMouse.z))",
                                           "float(floatBitsToUint(iMouse.w))"};
    EXPECT_THAT(told(bits, inputs), ElementsAre(0.0f, 0.0f));
    EXPECT_THAT(told(bits, clicked), ElementsAre(0.0f, 0.0f)); // no negative zero either
}

TEST_F(UniformTest, redeclared_uniforms_get_converted_values) {
    FrameInputs inputs;
    inputs.frame = 41;
    inputs.time = 2.75;
    inputs.mouse = {10, 20, 30, -40};
    const auto value = [&](const char* declaration, const char* expression) {
        return told({expression}, inputs, fmt::format("uniform {};", declaration), {32, 2})[0];
    };
    EXPECT_EQ(value("float iFrame", "iFrame"), 41.0f);
    EXPECT_EQ(value("uint iFrame", "float(iFrame)"), 41.0f);
    EXPECT_EQ(value("vec2 iResolution", "iResolution.x + 100.0 * iResolution.y"), 232.0f);
    EXPECT_EQ(value("ivec3 iResolution", "float(iResolution.x + 100 * iResolution.y)"), 232.0f);
    EXPECT_EQ(value("vec4 iResolution", "iResolution.x + 100.0 * iResolution.y"), 232.0f);
    EXPECT_EQ(value("highp float iTime", "iTime"), 2.75f);
    EXPECT_EQ(value("int iTime", "float(iTime)"), 2.0f);
    EXPECT_EQ(value("vec2 iMouse", "iMouse.x + 100.0 * iMouse.y"), 2010.0f);
    EXPECT_EQ(value("vec3 iMouse", "iMouse.z"), 30.0f);
    EXPECT_EQ(value("ivec4 iMouse", "float(iMouse.w)"), -40.0f);
    EXPECT_EQ(value("uvec4 iMouse", "float(iMouse.w == uint(-40))"), 1.0f);
    for (const double none : {1e300, -1e300, double(INFINITY), double(NAN)}) {
        inputs.time = none;
        EXPECT_EQ(value("int iTime", "float(iTime)"), 0.0f) << none;
        EXPECT_EQ(value("uint iTime", "float(iTime)"), 0.0f) << none;
    }
    EXPECT_EQ(value("int iSampleRate", "float(iSampleRate)"), 44100.0f);
    EXPECT_EQ(value("float iChannelTime[2]", "iChannelTime[1]"), 0.0f);
}

TEST_F(UniformTest, iChannelResolution_that_the_author_declares_as_vec2) {
    const std::string before =
        "uniform vec2 iChannelResolution[4];\n#iChannel0 \"noise\"\n#iChannel2 \"noise\"\n";
    EXPECT_THAT(told({"iChannelResolution[0].x", "iChannelResolution[0].y", "iChannelResolution[1].x",
                      "iChannelResolution[2].x", "iChannelResolution[2].y"},
                     {}, before),
                ElementsAre(256.0f, 256.0f, 256.0f, 256.0f, 256.0f));
}

TEST_F(UniformTest, a_declaration_of_several_uniforms_is_handled_once) {
    EXPECT_THAT(told({"iTime", "iTimeDelta"}, inputs_of_frame(30, 60), "uniform float iTime, iTimeDelta;"),
                ElementsAre(0.5f, float(1 / 60.0)));
}

TEST_F(UniformTest, knobs_of_every_type) {
    const std::string before = R"(
        #iUniform float a = 0.1
        #iUniform vec2 b = vec2(0.25, -3.0)
        #iUniform vec3 c3 = vec3(1.0, 2.0, 3.0)
        #iUniform vec4 d = vec4(4.0, 5.0, 6.0, 7.0)
        #iUniform color3 e = color3(0.2, 0.4, 0.6)
        #iUniform int f = -9
        #iUniform ivec2 g = ivec2(10, 2147483647)
        #iUniform ivec3 h = ivec3(12, 13, 14)
        #iUniform ivec4 i = ivec4(15, 16, 17, -18)
    )";
    EXPECT_THAT(told({"a",          "b.x",        "b.y",        "c3.x",
                      "c3.y",       "c3.z",       "d.x",        "d.y",
                      "d.z",        "d.w",        "e.r",        "e.g",
                      "e.b",        "float(f)",   "float(g.x)", "float(g.y >> 16)",
                      "float(h.x)", "float(h.y)", "float(h.z)", "float(i.x)",
                      "float(i.y)", "float(i.z)", "float(i.w)"},
                     {}, before),
                ElementsAreArray(Values{0.1f, 0.25f, -3, 1,     2,  3,  4,  5,  6,  7,  0.2f, 0.4f,
                                        0.6f, -9,    10, 32767, 12, 13, 14, 15, 16, 17, -18}));
}

TEST_F(UniformTest, set_knob_has_its_value_and_unused_knob_is_ignored) {
    scene::Scene scene = scene_of("#iUniform float used = 1.0\n#iUniform vec4 unused = vec4(1.0)\n"
                                  "void mainImage(out vec4 c, in vec2 p) { c = vec4(used); }\n");
    ASSERT_TRUE(scene::override_knob(scene, "used=0.75"));
    ASSERT_TRUE(scene::override_knob(scene, "unused=5"));
    Renderer drawing = renderer(scene, {1, 1});
    EXPECT_EQ(floats_at(frame(drawing), 0, 0)[0], 0.75f);
}

/// Columns first.
Values matrix_of(const OrbitCamera& camera) {
    const glm::mat4 matrix = camera.matrix();
    return {&matrix[0][0], &matrix[0][0] + 16};
}

class CameraTest : public UniformTest {
protected:
    Values seen(const OrbitCamera& camera) const {
        std::vector<std::string> elements;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                elements.push_back(fmt::format("iCamera[{}][{}]", column, row));
        FrameInputs inputs;
        inputs.camera = camera.matrix();
        return told(elements, inputs, "uniform mat4 iCamera;");
    }
    /// Returns the vector multiplied by the matrix in the shader.
    Values moved(const OrbitCamera& camera, const char* vector) const {
        FrameInputs inputs;
        inputs.camera = camera.matrix();
        const std::string product = fmt::format("(iCamera * {})", vector);
        return told({product + ".x", product + ".y", product + ".z"}, inputs, "uniform mat4 iCamera;");
    }
};

TEST_F(CameraTest, matrix_arrives_element_by_element) {
    const OrbitCamera camera{33, 21, 7.5, {1, -2, 3}};
    EXPECT_EQ(seen(camera), matrix_of(camera));
}

TEST_F(CameraTest, its_motion_arrives_number_by_number) {
    FrameInputs inputs;
    inputs.orbit = {0.25, -0.5, 2, 1};
    inputs.orbit_pan = {1, -2, 4};
    EXPECT_THAT(
        told({"iOrbit.x", "iOrbit.y", "iOrbit.z", "iOrbit.w", "iOrbitPan.x", "iOrbitPan.y", "iOrbitPan.z"},
             inputs, "uniform vec4 iOrbit;\nuniform vec3 iOrbitPan;"),
        ElementsAre(0.25f, -0.5f, 2.0f, 1.0f, 1.0f, -2.0f, 4.0f));
}

TEST_F(CameraTest, transforms_from_camera_to_world) {
    const OrbitCamera front{0, 0, 5};
    EXPECT_THAT(moved(front, "vec4(0, 0, 0, 1)"), ElementsAre(0.0f, 0.0f, 5.0f));   // stands on +z
    EXPECT_THAT(moved(front, "vec4(0, 0, -1, 0)"), ElementsAre(0.0f, 0.0f, -1.0f)); // looks along -z
    const OrbitCamera above{0, 90, 2, {10, 0, 0}}; // not clamped: made by hand
    const Values at = moved(above, "vec4(0, 0, 0, 1)");
    EXPECT_NEAR(at[0], 10, 1e-5);
    EXPECT_NEAR(at[1], 2, 1e-5);
    EXPECT_NEAR(at[2], 0, 1e-5);
}

} // namespace tidemark::render::uniform_gl_test
