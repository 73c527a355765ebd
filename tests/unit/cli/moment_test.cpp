// A moment comes back from its JSON; a stranger's JSON is refused.
#include "host/moment.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace tidemark::host::moment_test {

using testing::ElementsAre;

Moment example() {
    SceneRequest scene{.path = "a.glsl", .sets = {"k=1"}, .defines = {"N=3"}, .channels = {"0=noise"}};
    scene.doubles = true;
    FrameSequence sequence;
    sequence.lead_in_fps = 60;
    render::FrameState state{.frame = 7, .time = 0.125, .extent = {30, 20}};
    state.mouse = render::Mouse::clicked({4, 5}, false);
    state.camera.target = {1, 2, 3};
    state.knobs = {{"k", {1, {2}}}};
    return moment_of(std::move(scene), sequence, state);
}

TEST(Moment, survives_conversion_to_json) {
    const Moment moment = example();
    const auto back = moment_of(Json::parse(dump(to_json(moment))));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->sequence.state, moment.sequence.state);
    EXPECT_EQ(back->sequence.lead_in_fps, 60);
    EXPECT_EQ(dump(to_json(*back)), dump(to_json(moment)));
}

TEST(Moment, becomes_a_command) {
    EXPECT_EQ(capture_command(example()), "tidemark capture a.glsl --set k=1 --define N=3 --channel 0=noise "
                                          "--time 0.125 --size 30x20 --mouse 4,5 "
                                          "--camera 30,20,10,1,2,3 --set k=2 --precision double");
}

TEST(Moment, invalid_state_is_refused) {
    for (const char* state :
         {R"({"frame": -1})", R"({"size": [0, 5]})", R"({"size": [5]})", R"({"fps": 0})",
          R"({"camera": [0, 0, 0, [0, 0, 0]]})", R"({"camera": [0, 0, 1, [0, 0]]})",
          R"({"date": [2024, 12, 1, 0]})", R"({"mouse": [[1e9, 0], [0, 0], false, false]})",
          R"({"keys": [1]})", R"({"knobs": [["k"]]})", R"({"time": "now"})"})
        EXPECT_FALSE(moment_of(Json{{"scene", "a.glsl"}, {"state", Json::parse(state)}})) << state;
    EXPECT_FALSE(moment_of(Json()));
    EXPECT_FALSE(moment_of(Json{{"state", Json::object()}}));
    EXPECT_TRUE(moment_of(Json{{"scene", "a.glsl"}, {"state", Json::object()}}));
    const auto state = Json::parse(R"({"knobs": [["height", "tall"]]})");
    const auto moment = moment_of(Json{{"scene", "a.glsl"}, {"state", state}});
    ASSERT_FALSE(moment);
    EXPECT_EQ(moment.error().message,
              "'tall' is not a value for height: give a number, up to four as in 1,2,3, #rrggbb or default");
}

TEST(Merged, newer_settings_of_a_name_replace_older_settings) {
    EXPECT_THAT(merged({"a=1", "b=2", "a=3"}, {"a=4", "c=5"}), ElementsAre("b=2", "a=4", "c=5"));
}

} // namespace tidemark::host::moment_test
