// Options for sizes, frames and the mouse, and the state of a frame that follows from them.
#include "host/requests.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>

namespace tidemark::host::requests_test {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

TEST(ParseSize, width_x_height) {
    EXPECT_EQ(parse_size("640x360"), (Extent{640, 360}));
    EXPECT_EQ(parse_size("1x1"), (Extent{1, 1}));
    for (const std::string text : {"", "640", "640x", "x360", "0x5", "5x0", "-1x5", "640X360", "640x360 ",
                                   " 640x360", "640x360x2", "6.5x3", "99999999999x1", "640*360"}) {
        const auto size = parse_size(text);
        ASSERT_FALSE(size) << text;
        EXPECT_EQ(size.error().code, ErrorCode::usage);
        EXPECT_EQ(size.error().message,
                  "--size " + text + ": give WIDTHxHEIGHT in pixels, both at least 1, as in 640x360");
    }
}

std::vector<int> frames(std::string_view text) {
    return parse_frames(text).value_or(std::vector<int>{-1});
}

TEST(ParseFrames, are_inclusive) {
    EXPECT_THAT(frames("7"), ElementsAre(7));
    EXPECT_THAT(frames("0-3"), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(frames("5-5"), ElementsAre(5));
}

TEST(ParseFrames, steps_end_within_the_range) {
    EXPECT_THAT(frames("1-10x3"), ElementsAre(1, 4, 7, 10));
    EXPECT_THAT(frames("1-9x3"), ElementsAre(1, 4, 7));
    EXPECT_THAT(frames("1-3x100"), ElementsAre(1));
    EXPECT_THAT(frames("0-100000000x99999999"), ElementsAre(0, 99999999));
}

TEST(ParseFrames, backwards) {
    EXPECT_THAT(frames("3-0"), ElementsAre(3, 2, 1, 0));
    EXPECT_THAT(frames("10-1x4"), ElementsAre(10, 6, 2));
}

TEST(ParseFrames, several_ranges_keep_their_order) {
    EXPECT_THAT(frames("5,0-2,9-7"), ElementsAre(5, 0, 1, 2, 9, 8, 7));
    EXPECT_THAT(frames("1,1"), ElementsAre(1, 1));
}

TEST(ParseFrames, bounds) {
    EXPECT_THAT(frames("100000000"), ElementsAre(100'000'000));
    EXPECT_EQ(frames("1-10000000").size(), 10'000'000u);
    for (const char* text :
         {"100000001", "0-100000001", "0-10000000", "1-10000000,1", "99999999999", "0-5000000,0-5000000"})
        EXPECT_FALSE(parse_frames(text)) << text;
}

TEST(ParseFrames, invalid_ranges) {
    for (const std::string text :
         {"",     "x",    "-1",   "1-",      "1-x3",  "1-5x",  "1-5x0", "1-5x-1", "1,",    ",1",
          "1,,2", "5,1-", "5,1x", "5,1-2x0", "1-2-3", "1 - 2", "1;2",   "1.5",    "0-5y2", "1-5x2x2"}) {
        const auto parsed = parse_frames(text);
        ASSERT_FALSE(parsed) << text;
        EXPECT_EQ(parsed.error().code, ErrorCode::usage);
        EXPECT_EQ(parsed.error().message,
                  "--frames " + text +
                      ": give frames from 0 to 100000000 as in 7, 0-29, 0-120x10 or 0-9,20-29");
    }
}

std::optional<glm::vec4> i_mouse(std::string_view text) {
    const auto mouse = parse_mouse(text);
    return mouse ? std::optional(mouse->uniform()) : std::nullopt;
}

TEST(ParseMouse, after_a_click) {
    EXPECT_EQ(i_mouse("30,40"), glm::vec4(30, 40, -30, -40));
    EXPECT_EQ(i_mouse("30.9,40.1"), glm::vec4(30, 40, -30, -40));
    EXPECT_EQ(i_mouse("0,0"), glm::vec4(0));
    EXPECT_EQ(i_mouse("-5,1e3"), glm::vec4(-5, 1000, 5, -1000));
}

TEST(ParseMouse, in_the_frame_of_the_press) {
    EXPECT_EQ(i_mouse("30,40,down"), glm::vec4(30, 40, 30, 40));
}

TEST(ParseMouse, after_a_drag_and_before_its_end) {
    EXPECT_EQ(i_mouse("30,40,5,6"), glm::vec4(30, 40, -5, -6));
    EXPECT_EQ(i_mouse("30.9,-40,5.9,6,down"), glm::vec4(30, -40, 5, -6));
}

TEST(ParseMouse, invalid_mouse_positions) {
    for (const std::string text :
         {"",      "1",      "1,",           ",1",        "1,2,",      "1,2,up",    "1,2,down,",
          "1,2,3", "1,2,3,", "1,2,down,3,4", "1,2,3,nan", "1,2,3,4,5", "1,2,3,4,",  "1;2",
          " 1,2",  "nan,1",  "1,inf",        "1e300,1",   "1,-1e300",  "16777217,0"}) {
        const auto mouse = parse_mouse(text);
        ASSERT_FALSE(mouse) << text;
        EXPECT_EQ(mouse.error().code, ErrorCode::usage);
        EXPECT_EQ(mouse.error().message,
                  "--mouse " + text +
                      ": give x,y for a click or x,y,from_x,from_y for a drag, in pixels from the bottom "
                      "left, and ,down while the button is pressed");
    }
}

TEST(StatesOf, a_frame_has_the_requested_state) {
    FrameSequence sequence;
    sequence.state.fps = 24;
    sequence.state.mouse = render::Mouse::clicked({1, 2}, false);
    sequence.state.date = {2020, 5, 6, 7};
    sequence.state.camera.azimuth = 90;
    const render::FrameInputs inputs = inputs_of(states_of(sequence)(12));
    EXPECT_EQ(inputs.frame, 12);
    EXPECT_EQ(inputs.time, 0.5);
    EXPECT_EQ(inputs.time_delta, 1 / 24.0);
    EXPECT_EQ(inputs.mouse, glm::vec4(1, 2, -1, -2));
    EXPECT_EQ(inputs.date, (render::Date{2020, 5, 6, 7.5})) << "iDate goes on with iTime";
    EXPECT_EQ(inputs.camera, sequence.state.camera.matrix());
    EXPECT_EQ(inputs.view, glm::mat4(1));
}

TEST(StatesOf, a_mouse_moves_the_camera_only_with_an_initial_camera) {
    render::FrameState state;
    state.mouse = render::Mouse::clicked({1, 2}, false);
    EXPECT_EQ(inputs_of(state).orbit, glm::dvec4(0, 0, 1, 0)) << "--mouse";
    EXPECT_THAT(option_words(state), Not(Contains("--camera")));
    state.initial_camera = state.camera;
    EXPECT_EQ(inputs_of(state).orbit, glm::dvec4(0, 0, 1, 1)) << "--mouse --camera, a window";
    EXPECT_THAT(option_words(state), Contains("--camera"));
    state.mouse = {};
    EXPECT_EQ(inputs_of(state).orbit.w, 0) << "nothing was touched";
    state.camera.distance = 20;
    EXPECT_EQ(inputs_of(state).orbit, glm::dvec4(0, 0, 2, 1));
}

TEST(StatesOf, a_time_selects_a_frame_and_shifts_the_earlier_frames) {
    FrameSequence sequence{render::at_time(1.999)};
    EXPECT_EQ(sequence.state.frame, 119);
    const render::FrameStates states = states_of(sequence);
    EXPECT_EQ(states(119).seconds(), 1.999);
    EXPECT_EQ(states(118).frame, 118);
    EXPECT_EQ(states(59).seconds(), 1.999 - 1);
}

TEST(StatesOf, a_recording_moves_the_mouse) {
    FrameSequence sequence;
    sequence.input = {{3, host::ButtonPressed{host::Button::left, {10, 20}}}};
    const render::FrameStates states = states_of(sequence);
    EXPECT_EQ(states(3).mouse.uniform(), glm::vec4(10, 20, 10, 20));
    EXPECT_EQ(states(2).mouse, render::Mouse());
    EXPECT_EQ(states(4).mouse.uniform(), glm::vec4(10, 20, 10, -20));
}

TEST(FrameAt, is_the_frame_that_contains_a_time) {
    EXPECT_EQ(render::frame_at(0, 60), 0);
    EXPECT_EQ(render::frame_at(2, 60), 120);
    EXPECT_EQ(render::frame_at(1.999, 60), 119);
    EXPECT_EQ(render::frame_at(-5, 60), 0);
    EXPECT_EQ(render::frame_at(1e300, 60), render::k_last_frame);
}

TEST(Load, applies_every_option) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.glsl", "#define A 1\n#iUniform float k = 1.0\nvoid mainImage() {}\n");
    const SceneRequest request{folder / "a.glsl", {"k=2", "k=3"}, {"A=2"}, {"0=none", "1=t.png"}};
    const auto scene = load(request);
    ASSERT_TRUE(scene) << to_string(scene.error());
    EXPECT_EQ(scene->knobs[0].value[0], 3) << "the last one counts";
    EXPECT_EQ(scene->image().text.text(), "#define A 2\n\nvoid mainImage() {}\n");
    EXPECT_EQ(scene->image().channels[0].input, scene::ChannelInput(scene::Unbound{}));
    EXPECT_EQ(scene->image().channels[1].input, scene::ChannelInput(scene::Picture{"t.png"}));
}

TEST(Load, returns_the_first_error) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.glsl", "void mainImage() {}\n");
    const auto message = [](const SceneRequest& request) {
        const auto scene = load(request);
        return scene ? "" : to_string(scene.error());
    };
    const std::string path = folder / "a.glsl";
    EXPECT_EQ(message({path, {"k=2"}, {}, {}}),
              "tidemark: error: the scene has no knob 'k': it declares none with #iUniform");
    EXPECT_EQ(message({path, {}, {"A=2"}, {}}),
              "tidemark: error: the scene has no #define or const 'A': it defines none");
    EXPECT_EQ(message({path, {}, {}, {"10=noise"}}),
              "tidemark: error: --channel 10=noise: give it as N=FILE, N=noise or N=none, N from 0 to 9");
    EXPECT_EQ(message({folder / "b.glsl", {"k"}, {}, {}}),
              "tidemark: error: cannot read '" + (folder / "b.glsl").string() + "': no such file");
}

TEST(Load, refuses_a_saved_value_of_the_wrong_type) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.glsl", "#iUniform float k = 1.0\nvoid mainImage() {}\n");
    SceneRequest request{folder / "a.glsl"};
    FrameSequence sequence;
    sequence.state.knobs = {{"k", {1, {2}}}, {"gone", {1, {2}}}};
    EXPECT_TRUE(load(request, sequence));
    sequence.state.knobs = {{"k", {2, {1, 2}}}};
    const auto scene = load(request, sequence);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().message, "'1,2' is not a value for k (float): give a number");
    request.knobs_may_go = true;
    EXPECT_TRUE(load(request, sequence));
}

} // namespace tidemark::host::requests_test
