#include "host/input_script.hpp"

#include <gmock/gmock.h>

namespace tidemark::host::input_script_test {

using host::Button;
using host::Key;

const InputScript k_script{
    {0, host::ButtonPressed{Button::left, {10, 20.5}}},
    {2, host::PointerMoved{{-3, 1e-3}}},
    {2, PointerFollowed{{4, 5}}},
    {2, host::ButtonReleased{Button::left}},
    {5, host::KeyPressed{Key::a}},
    {5, host::WheelTurned{0, -1}},
    {9, host::KeyReleased{Key::a}},
    {9, host::ButtonPressed{Button::middle, {0, 0}}},
    {9, host::ButtonReleased{Button::middle}},
    {12, CameraReset{}},
    {13, KnobTurned{{"deep", {3, {0.1, 0, 1}, scene::KnobType::vec3}}}},
};

constexpr const char* k_text =
    "0 press left 10 20.5\n2 move -3 0.001\n2 point 4 5\n2 release left\n5 keydown 65\n5 wheel -1\n"
    "9 keyup 65\n9 press middle 0 0\n9 release middle\n12 camera reset\n13 set deep=vec3(0.1, 0, 1)\n";

/// What is wrong with a text.
std::string refusal(std::string_view text) {
    const auto script = parse_input_script(text, "take.txt");
    return script ? "" : to_string(script.error());
}

TEST(InputScript, is_written_and_read) {
    EXPECT_EQ(to_string(k_script), k_text);
    EXPECT_EQ(parse_input_script(k_text, "take.txt"), k_script);
}

TEST(InputScript, takes_comments_blanks_and_other_line_ends) {
    const auto script = parse_input_script("# a take\r\n\n \t0\tpress  left 10 20.5 # here\r\n", "take.txt");
    ASSERT_TRUE(script) << to_string(script.error());
    EXPECT_EQ(*script, InputScript{k_script[0]});
    EXPECT_EQ(parse_input_script("", "take.txt"), InputScript{});
}

TEST(InputScript, keys_have_names) {
    const auto named = parse_input_script("0 keydown a\n0 keyup Z\n1 keydown Space\n1 keyup ArrowLeft\n"
                                          "2 keydown f1\n2 keyup F24\n",
                                          "take.txt");
    ASSERT_TRUE(named) << to_string(named.error());
    EXPECT_EQ(to_string(*named),
              "0 keydown 65\n0 keyup 90\n1 keydown 32\n1 keyup 37\n2 keydown 112\n2 keyup 135\n");
    EXPECT_NE(refusal("1 keydown f25"), "");
    EXPECT_NE(refusal("1 keydown spacebar"), "");
}

TEST(InputScript, errors_name_reason_and_place) {
    const std::string number = "a line must begin with a frame number, as in `12 move 100 50`";
    EXPECT_EQ(refusal("press left 1 2"), "take.txt:1: error: " + number);
    EXPECT_EQ(refusal("\n# x\n-1 move 1 2"), "take.txt:3: error: " + number);
    EXPECT_EQ(refusal("100000001 move 1 2"), "take.txt:1: error: " + number);
    EXPECT_EQ(refusal("1 moves 1 2"),
              "take.txt:1: error: unknown event 'moves': give press, release, move, point, "
              "wheel, keydown, keyup, set or camera");
    EXPECT_EQ(refusal("1"),
              "take.txt:1: error: unknown event '': give press, release, move, point, wheel, keydown, "
              "keyup, set or camera");
    EXPECT_EQ(refusal("1 move 1"), "take.txt:1: error: give it as `1 move X Y`");
    EXPECT_EQ(refusal("1 move 1 nan"), "take.txt:1: error: give it as `1 move X Y`");
    EXPECT_EQ(refusal("1 move 1 2 3"), "take.txt:1: error: give it as `1 move X Y`");
    EXPECT_EQ(refusal("1 set deep"), "take.txt:1: error: give it as `1 set NAME=VALUE`");
    EXPECT_EQ(refusal("1 set"), "take.txt:1: error: give it as `1 set NAME=VALUE`");
    EXPECT_EQ(refusal("0 set deep=1\n1 set deep=blue"), "take.txt:2: error: 'blue' is not a value for deep: "
                                                        "give a number, up to four as in 1,2,3, #rrggbb or "
                                                        "default");
    EXPECT_EQ(refusal("1 press west 1 2"), "take.txt:1: error: give it as `1 press left|middle|right X Y`");
    EXPECT_EQ(refusal("1 keydown 0"), "take.txt:1: error: give it as `1 keydown KEY (a name as in "
                                      "a, space, left or F1, or a code from 1 to 255)`");
    EXPECT_EQ(refusal("1 camera"), "take.txt:1: error: give it as `1 camera reset`");
    EXPECT_EQ(refusal("1 keyup 256"), "take.txt:1: error: give it as `1 keyup KEY (a name as in a, "
                                      "space, left or F1, or a code from 1 to 255)`");
    EXPECT_EQ(refusal("7 wheel 1\n6 wheel 1"),
              "take.txt:2: error: frame 6 follows frame 7: frames must be in ascending order");
}

TEST(InputScript, values_are_written_in_their_shortest_form) {
    const auto script = parse_input_script("1 set k=0.50\n2 set k=1 , 2\n3 set k=default\n", "take.txt");
    ASSERT_TRUE(script) << to_string(script.error());
    EXPECT_EQ(to_string(*script), "1 set k=0.5\n2 set k=1,2\n3 set k=default\n");
}

TEST(InputScript, must_match_the_knobs_of_the_scene) {
    const std::vector<scene::Knob> knobs{{.name = "deep", .type = scene::KnobType::vec3}};
    const auto check = [&](const char* name, const scene::GivenValue& value) {
        const auto known = check_knobs({{0, KnobTurned{{name, value}}}}, knobs);
        return known ? "" : known.error().message;
    };
    EXPECT_EQ(check("deep", {1, {2}}), "");
    EXPECT_EQ(check("deep", {2, {1, 2}}),
              "'1,2' is not a value for deep (vec3): give 3 numbers, as in 1,2,3");
    EXPECT_EQ(check("deeper", {1, {2}}), "the scene has no knob 'deeper': did you mean 'deep'?");
}

std::vector<scene::KnobSetting> held_by(const Controls& controls) {
    render::FrameState state;
    controls.fill(state);
    return state.knobs;
}

TEST(Controls, release_values_unused_or_invalid_in_a_scene) {
    Controls controls{render::OrbitCamera{}};
    const scene::GivenValue pair{2, {1, 2}}, one{1, {1}};
    for (const scene::KnobSetting& setting :
         {scene::KnobSetting{"other", pair}, scene::KnobSetting{"same", one}, scene::KnobSetting{"kept", one},
          scene::KnobSetting{"gone", one}})
        controls.handle(KnobTurned{setting}, 1);
    const std::vector<scene::Knob> knobs{
        {.name = "other"}, {.name = "same", .initial = {1}, .value = {1}}, {.name = "kept"}};
    EXPECT_THAT(controls.release(knobs),
                testing::ElementsAre("'1,2' is not a value for other (float): give a number"));
    EXPECT_THAT(held_by(controls),
                testing::ElementsAre(scene::KnobSetting{"kept", one}, scene::KnobSetting{"gone", one}));
}

render::FrameInputs at(Replay& replay, int frame) {
    render::FrameState state{.frame = frame, .extent = {100, 100}};
    replay.fill(state);
    return inputs_of(state);
}

TEST(Replay, applies_events_at_their_frames) {
    Replay replay(k_script, {});
    EXPECT_EQ(at(replay, 0).mouse, glm::vec4(10, 20, 10, 20)); // pressed in this frame
    EXPECT_EQ(at(replay, 1).mouse, glm::vec4(10, 20, 10, -20));
    EXPECT_EQ(at(replay, 2).mouse, glm::vec4(4, 5, -10, -20));
    EXPECT_EQ(at(replay, 4).keyboard[65], 0);
    EXPECT_EQ(at(replay, 5).keyboard[65], 255);
    EXPECT_EQ(at(replay, 5).keyboard[256 + 65], 255); // the same frame again is the same
    EXPECT_EQ(at(replay, 6).keyboard[256 + 65], 0);
    EXPECT_EQ(at(replay, 9).keyboard[65], 0);
    EXPECT_EQ(at(replay, 9).keyboard[3 * 256 + 65], 255);
    EXPECT_NE(at(replay, 9).camera, at(replay, 4).camera); // the wheel
    Replay untouched({}, {});
    EXPECT_EQ(at(replay, 12).camera, at(untouched, 12).camera);
}

TEST(Replay, events_can_be_added_during_replay) {
    Replay written({}, {});
    for (int frame = 0; frame < 12; ++frame) {
        for (const TimedEvent& timed : k_script)
            if (timed.frame == frame)
                written.note(frame, timed.event);
        Replay read(k_script, {});
        EXPECT_EQ(at(written, frame).mouse, at(read, frame).mouse) << frame;
        EXPECT_EQ(at(written, frame).keyboard, at(read, frame).keyboard) << frame;
        EXPECT_EQ(at(written, frame).camera, at(read, frame).camera) << frame;
    }
}

TEST(Replay, going_back_discards_later_events) {
    Replay replay({}, {});
    replay.note(3, host::WheelTurned{0, 1});
    replay.note(8, host::WheelTurned{0, 2});
    const glm::mat4 shown = at(replay, 7).camera;
    EXPECT_NE(at(replay, 9).camera, shown);
    replay.go_back(4);
    EXPECT_EQ(to_string(replay.script()), "3 wheel 1\n");
    EXPECT_EQ(at(replay, 4).camera, shown);
    EXPECT_EQ(at(replay, 9).camera, shown);
    replay.note(4, CameraReset{});
    EXPECT_EQ(to_string(replay.script()), "3 wheel 1\n4 camera reset\n");
}

TEST(Replay, a_single_frame_equals_the_same_frame_of_a_sequence) {
    Replay stepped(k_script, {});
    for (int frame = 0; frame < 12; ++frame) {
        const render::FrameInputs one = at(stepped, frame);
        Replay alone(k_script, {});
        Replay backwards(k_script, {});
        at(backwards, 20);
        for (Replay* replay : {&alone, &backwards}) {
            const render::FrameInputs other = at(*replay, frame);
            EXPECT_EQ(other.mouse, one.mouse) << frame;
            EXPECT_EQ(other.keyboard, one.keyboard) << frame;
            EXPECT_EQ(other.camera, one.camera) << frame;
        }
    }
}

TEST(Controls, a_followed_pointer_moves_the_mouse_without_a_button) {
    Controls controls{render::OrbitCamera()};
    EXPECT_FALSE(controls.handle(host::PointerMoved{{9, 9}}, 100));
    EXPECT_TRUE(controls.handle(PointerFollowed{{12.7, 30.2}}, 100));
    render::FrameState state;
    controls.fill(state);
    EXPECT_EQ(state.mouse.uniform(), glm::vec4(12, 30, 0, 0));
}

} // namespace tidemark::host::input_script_test
