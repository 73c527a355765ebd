#include "window/osc.hpp"

#include <gmock/gmock.h>

namespace tidemark::window::osc_test {

using namespace overlay;

using scene::Knob;
using scene::KnobType;
using testing::ElementsAre;

// OSC 1.0: an address and a list of types, each ended by a zero and filled up to four bytes; then the
// arguments.
using namespace std::string_literals;
const std::string k_half = "/knob/a\0,f\0\0\x3f\0\0\0"s;
const std::string k_time_tag(8, '\0');

std::string size_of(const std::string& packet) {
    return "\0\0\0"s + char(packet.size());
}

TEST(ParseOsc, reads_each_type) {
    const auto read = parse_osc("/a\0\0,ihfdTFs\0\0\0\0"
                                "\xff\xff\xff\xfe"
                                "\0\0\0\1\0\0\0\0"
                                "\x3d\xcc\xcc\xcd"
                                "\x3f\xb9\x99\x99\x99\x99\x99\x9a"
                                "abc\0"s);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_THAT(*read, ElementsAre(OscMessage{"/a", {-2.0, 4294967296.0, 0.1, 0.1, 1.0, 0.0, "abc"}}));
}

TEST(ParseOsc, reads_bundles_in_order) {
    const std::string inner = "#bundle\0"s + k_time_tag + size_of(k_half) + k_half;
    const std::string play = "/play\0\0\0,\0\0\0"s;
    const auto read = parse_osc("#bundle\0"s + k_time_tag + size_of(inner) + inner + size_of(play) + play);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_THAT(*read, ElementsAre(OscMessage{"/knob/a", {0.5}}, OscMessage{"/play"}));
}

TEST(ParseOsc, truncated_packets_are_errors_or_packets) {
    const std::string whole = "#bundle\0"s + k_time_tag + size_of(k_half) + k_half;
    const size_t empty_bundle = 8 + k_time_tag.size();
    for (size_t size = 0; size < whole.size(); ++size)
        EXPECT_EQ(bool(parse_osc(whole.substr(0, size))), size == empty_bundle) << size;
    for (size_t size = 0; size < k_half.size(); ++size)
        EXPECT_FALSE(parse_osc(k_half.substr(0, size))) << size;
    EXPECT_TRUE(parse_osc(whole));
}

TEST(ParseOsc, refuses_other_argument_types) {
    EXPECT_EQ(parse_osc("/a\0\0,b\0\0\0\0\0\4abcd"s).error().message,
              "'/a' has an argument of type 'b': give numbers");
}

struct Case {
    OscMessage message;
    scene::KnobValue value;
};

const std::vector<Knob> k_knobs = {
    {.name = "height", .initial = {0.5}, .value = {0.7}, .range = {{{0}, {2}}}},
    {.name = "tint", .type = KnobType::color3, .value = {0.1, 0.2, 0.3}},
    {.name = "grid", .type = KnobType::ivec2, .value = {3, 4}},
};

TEST(OscCommand, sets_knobs_in_their_units) {
    const Case cases[] = {
        {{"/knob/height", {1.5}}, {1.5}},
        {{"/knob/height", {7.0}}, {7}}, // a value may lie outside the slider's range
        {{"/knob/height", {"default"}}, {0.5}},
        {{"/knob/tint", {0.5}}, {0.5, 0.5, 0.5}},
        {{"/knob/tint", {0.5, 0.25, 1.0}}, {0.5, 0.25, 1}},
        {{"/knob/tint", {"#ff0000"}}, {1, 0, 0}},
        {{"/knob/tint/g", {0.9}}, {0.1, 0.9, 0.3}},
        {{"/knob/tint/z", {0.9}}, {0.1, 0.2, 0.9}},
        {{"/knob/grid/y", {6.4}}, {3, 6}},
    };
    for (const Case& each : cases) {
        const auto command = osc_command(each.message, k_knobs);
        ASSERT_TRUE(command) << each.message.address << ": " << command.error().message;
        EXPECT_EQ(std::get<TurnKnob>(*command).value, each.value) << each.message.address;
    }
}

TEST(OscCommand, moves_time) {
    EXPECT_EQ(std::get<Seek>(*osc_command({"/time", {2.5}}, {})).seconds, 2.5);
    EXPECT_TRUE(std::get<SetPlaying>(*osc_command({"/play"}, {})).on);
    EXPECT_FALSE(std::get<SetPlaying>(*osc_command({"/play", {0.0}}, {})).on);
}

TEST(OscCommand, reports_errors) {
    const std::pair<OscMessage, std::string_view> cases[] = {
        {{"/knob/heigth", {1.0}}, "OSC: the scene has no knob 'heigth': did you mean 'height'?"},
        {{"/knob/height", {}}, "OSC: '' is not a value for height (float): give a number"},
        {{"/knob/height", {std::numeric_limits<double>::quiet_NaN()}},
         "OSC: 'nan' is not a value for height (float): give a number"},
        {{"/knob/tint", {1.0, 2.0}},
         "OSC: '1,2' is not a value for tint (color3): give 3 numbers, as in 1,2,3 or #rrggbb"},
        {{"/knob/tint/a", {1.0}}, "OSC: tint (color3) has no component 'a'"},
        {{"/knob/tint/rg", {1.0}}, "OSC: tint (color3) has no component 'rg'"},
        {{"/knob/tint/r", {1.0, 2.0}}, "OSC: '/knob/tint/r' takes one number"},
        {{"/knob/grid", {3e9}},
         "OSC: '3000000000' is not a value for grid (ivec2): give 2 whole numbers, as in 1,2"},
        {{"/time", {"soon"}}, "OSC: /time takes one number of seconds, 0 or more"},
        {{"/play", {"no"}}, "OSC: /play takes 1 or 0"},
        {{"/stop"}, "OSC: unknown address '/stop': send /knob/NAME, /time or /play"},
    };
    for (const auto& [message, words] : cases) {
        const auto command = osc_command(message, k_knobs);
        ASSERT_FALSE(command) << message.address;
        EXPECT_EQ(command.error().message, words);
    }
}

TEST(OscAddress, is_local_by_default) {
    EXPECT_EQ(parse_osc_address("9000").value(), (OscAddress{"127.0.0.1", "9000"}));
    EXPECT_EQ(parse_osc_address("0.0.0.0:9000").value(), (OscAddress{"0.0.0.0", "9000"}));
    EXPECT_EQ(parse_osc_address("[::1]:0").value(), (OscAddress{"::1", "0"}));
    for (const char* wrong : {"", ":", ":9000", "x", "9000x", "70000", "host:", "-1"})
        EXPECT_FALSE(parse_osc_address(wrong)) << wrong;
}

} // namespace tidemark::window::osc_test
