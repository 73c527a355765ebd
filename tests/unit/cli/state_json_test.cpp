// A FrameState's way into JSON and onto a command line: no field is lost.
#include "host/json.hpp"
#include "host/requests.hpp"
#include "render/frame_state.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace tidemark::host::state_json_test {

using render::FrameState;
using testing::ElementsAre;

/// Every field is another than usual.
FrameState unusual() {
    FrameState state{.frame = 7,
                     .time = 0.1,
                     .extent = {3, 2},
                     .fps = 24,
                     .bpm = 90,
                     .time_delta = 0.25,
                     .mouse = render::Mouse::dragged({1, 2}, {-3, 4}, true),
                     .right_button = true,
                     .date = {2020, 1, 29, 3723.5},
                     .camera = {.azimuth = 1.0 / 3, .elevation = -5, .distance = 7.5, .target = {1, 2, 3}},
                     .initial_camera = render::OrbitCamera{.distance = 3},
                     .knobs = {{"k", {2, {0, 1}, scene::KnobType::vec2}}, {"l", {1, {2}}}},
                     .definitions = {{"N", "3 + 4"}},
                     .channels = {"0=none", "1=it's.png"},
                     .pass = "Buffer A"};
    state.keys[65] = 255;
    return state;
}

TEST(StateJson, every_field_survives) {
    const FrameState state = unusual(), usual;
    render::for_each_field([&](const auto& field) {
        EXPECT_NE(state.*field.member, usual.*field.member) << field.name << ": give it a value above";
    });
    EXPECT_EQ(frame_state_of(Json::parse(dump(to_json(state)))), state);
    EXPECT_EQ(frame_state_of(Json::parse(dump(to_json(usual)))), usual);
    EXPECT_EQ(frame_state_of(Json::parse(dump(changes_of(state)))), state);
    EXPECT_EQ(dump(changes_of(usual)), "{}");
    EXPECT_EQ(dump(to_json(state)["knobs"]), R"~([["k","vec2(0, 1)"],["l","2"]])~");
}

TEST(FrameFields, list_all_fields_in_order) {
    const FrameState state;
    const char* last = nullptr;
    render::for_each_field([&](const auto& field) {
        const auto* const at = reinterpret_cast<const char*>(&(state.*field.member));
        EXPECT_LT(last, at) << field.name;
        last = at;
    });
}

TEST(OptionWords, list_non_default_settings) {
    EXPECT_THAT(option_words(FrameState{.frame = 3}), ElementsAre("--frame", "3", "--size", "640x360"));
    EXPECT_THAT(option_words(unusual()),
                ElementsAre("--time", "0.1", "--size", "3x2", "--fps", "24", "--bpm", "90", "--mouse",
                            "-3,4,1,2,down", "--date", "2020-02-29T01:02:3.5", "--camera",
                            "0.3333333333333333,-5,7.5,1,2,3", "--set", "k=vec2(0, 1)", "--set", "l=2",
                            "--define", "N=3 + 4", "--channel", "0=none", "--channel", "1=it's.png", "--pass",
                            "Buffer A"));
}

TEST(OptionWords, mouse_and_date_survive_parsing) {
    for (const char* text : {"1,2", "1,2,down", "3,4,1,2", "3,4,1,2,down", "1,2,1,2,down"}) {
        const auto words = option_words(FrameState{.mouse = *parse_mouse(text)});
        EXPECT_EQ(words.back(), text);
    }
    const render::Date date{2024, 11, 31, 86399.5};
    EXPECT_EQ(render::parse_date(option_words(FrameState{.date = date}).back()), date);
}

} // namespace tidemark::host::state_json_test
