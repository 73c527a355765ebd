#include "window/midi.hpp"

#include <gmock/gmock.h>

namespace tidemark::window::midi_test {

using namespace std::string_literals;
using scene::Knob;
using scene::KnobType;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(MidiParser, reads_control_changes_however_they_are_cut) {
    // Two by running status, a clock within one, a note and a system exclusive message between.
    const std::string bytes = "\xb0\x07\x40\x07\xf8\x41\x90\x3c\x7f\xf0\x01\x02\x03\xf7\x05\x06\xbf\x77\x00"s;
    const std::vector<ControlChange> wanted = {{{1, 7}, 64}, {{1, 7}, 65}, {{16, 119}, 0}};
    EXPECT_EQ(MidiParser().parse(bytes), wanted);
    for (size_t at = 0; at <= bytes.size(); ++at) {
        MidiParser parser;
        auto parsed = parser.parse(bytes.substr(0, at));
        for (const ControlChange& change : parser.parse(bytes.substr(at)))
            parsed.push_back(change);
        EXPECT_EQ(parsed, wanted) << at;
    }
}

TEST(MidiParser, channel_mode_messages_are_ignored) {
    EXPECT_THAT(MidiParser().parse("\xb0\x7b\x00\x78\x00"s), IsEmpty());
}

TEST(MidiParser, may_start_within_a_message) {
    EXPECT_THAT(MidiParser().parse("\x12\x34\x56\xb1\x01\x02"s), ElementsAre(ControlChange{{2, 1}, 2}));
}

struct ValueCase {
    Knob knob;
    std::array<double, 3> at; ///< 0, 64, 127
};

TEST(ControllerValue, covers_the_range_from_end_to_end) {
    const ValueCase cases[] = {
        {{.name = "float", .range = {{{-1}, {3}}}}, {-1, -1 + 4 * 64 / 127.0, 3}},
        {{.name = "in steps", .range = {{{0}, {2}}}, .step = {{0.1}}}, {0, 1.0, 2}},
        {{.name = "backwards", .range = {{{2}, {0}}}}, {2, 2 - 2 * 64 / 127.0, 0}},
        {{.name = "no range"}, {0, 64 / 127.0, 1}},
        {{.name = "whole", .type = KnobType::int1, .range = {{{-2}, {8}}}}, {-2, 3, 8}},
        {{.name = "whole, no range", .type = KnobType::int1}, {0, 64, 127}},
        {{.name = "yes or no", .type = KnobType::int1, .range = {{{0}, {1}}}, .step = {{1}}}, {0, 1, 1}},
        {{.name = "colour", .type = KnobType::color3}, {0, 64 / 127.0, 1}},
    };
    for (const auto& [knob, at] : cases) {
        EXPECT_DOUBLE_EQ(value_at(knob, 0, 0), at[0]) << knob.name;
        EXPECT_DOUBLE_EQ(value_at(knob, 0, 64), at[1]) << knob.name;
        EXPECT_DOUBLE_EQ(value_at(knob, 0, 127), at[2]) << knob.name;
    }
    EXPECT_EQ(value_at({.name = "yes or no", .type = KnobType::int1, .range = {{{0}, {1}}}}, 0, 63), 0);
}

const std::vector<Knob> k_knobs = {
    {.name = "height", .value = {0.5}, .range = {{{0}, {2}}}},
    {.name = "tint", .type = KnobType::color3, .value = {0.1, 0.2, 0.3}},
};
constexpr Controller k_wheel{1, 1};
constexpr Controller k_fader{2, 7};

TEST(ControllerMap, learns_the_next_controller_that_moves) {
    ControllerMap map;
    EXPECT_FALSE(map.turn({k_wheel, 127}, k_knobs));
    map.learn({"tint", 1});
    EXPECT_EQ(map.learning(), (KnobPart{"tint", 1}));
    const auto turned = map.turn({k_wheel, 127}, k_knobs);
    ASSERT_TRUE(turned);
    EXPECT_EQ(turned->name, "tint");
    EXPECT_EQ(turned->value, (scene::KnobValue{0.1, 1, 0.3}));
    EXPECT_FALSE(map.learning());
    EXPECT_FALSE(map.turn({k_fader, 127}, k_knobs));
    EXPECT_EQ(ControllerMap(map.bindings()).turn({k_wheel, 0}, k_knobs)->value,
              (scene::KnobValue{0.1, 0, 0.3}));
}

TEST(ControllerMap, assigns_each_controller_and_component_once) {
    ControllerMap map;
    map.learn({"height", 0});
    map.turn({k_wheel, 1}, k_knobs);
    map.learn({"tint", 0});
    map.turn({k_wheel, 1}, k_knobs);
    EXPECT_EQ(map.controller_of({"height", 0}), std::nullopt);
    EXPECT_EQ(map.controller_of({"tint", 0}), k_wheel);
    map.learn({"tint", 0});
    map.turn({k_fader, 1}, k_knobs);
    EXPECT_THAT(map.bindings(), ElementsAre(Binding{k_fader, {"tint", 0}}));
    map.forget({"tint", 0});
    EXPECT_THAT(map.bindings(), IsEmpty());
}

TEST(ControllerMap, learning_ends_at_a_second_request) {
    ControllerMap map;
    map.learn({"height", 0});
    map.learn({"height", 0});
    EXPECT_FALSE(map.turn({k_wheel, 1}, k_knobs));
}

TEST(ControllerMap, assignments_of_another_scene_are_ignored) {
    ControllerMap map({{k_wheel, {"height", 1}}, {k_fader, {"gone", 0}}});
    EXPECT_FALSE(map.turn({k_wheel, 1}, k_knobs));
    EXPECT_FALSE(map.turn({k_fader, 1}, k_knobs));
}

} // namespace tidemark::window::midi_test
