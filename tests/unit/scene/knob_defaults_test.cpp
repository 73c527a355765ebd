// Values of knobs written into the lines that declare them.
#include "scene/knob.hpp"

#include <gtest/gtest.h>

namespace tidemark::scene::knob_defaults_test {

std::string written(std::string_view text, KnobType type, const KnobValue& value) {
    const auto changed = with_defaults(text, {Knob{.name = "k", .type = type, .value = value}});
    return changed ? *changed : changed.error().message;
}

TEST(KnobDefaults, replace_what_stands_behind_the_name) {
    EXPECT_EQ(written("#iUniform float k = 0.5 in { 0.0, 2.0 } step 0.1 // high\n", KnobType::float1, {1.25}),
              "#iUniform float k = 1.25 in { 0.0, 2.0 } step 0.1 // high\n");
    EXPECT_EQ(written("a\r\n#iUniform  float  k=-.5\r\nb", KnobType::float1, {-3}),
              "a\r\n#iUniform  float  k = -3\r\nb");
    EXPECT_EQ(written("#iUniform color3 k = color3(0.1, 0.2, 0.3)\nx", KnobType::color3, {1, 0.5, 0}),
              "#iUniform color3 k = color3(1, 0.5, 0)\nx");
    EXPECT_EQ(written("#iUniform ivec2 k = ivec2(\n1,\n2) in { 0, 9 }", KnobType::ivec2, {3, 4}),
              "#iUniform ivec2 k = ivec2(3, 4) in { 0, 9 }");
}

TEST(KnobDefaults, are_added_where_only_a_range_stands) {
    EXPECT_EQ(written("#iUniform int k in { 1, 9 }", KnobType::int1, {4}), "#iUniform int k = 4 in { 1, 9 }");
}

TEST(KnobDefaults, leave_other_knobs_and_comments_alone) {
    const std::string text = "// #iUniform float k = 1.0\n#iUniform float kk = 2.0\n#iUniform float k = 3.0";
    EXPECT_EQ(written(text, KnobType::float1, {9}), text.substr(0, text.size() - 3) + "9");
}

TEST(KnobDefaults, say_what_is_not_there) {
    EXPECT_EQ(written("#iUniform float other = 1.0", KnobType::float1, {9}),
              "there is no line '#iUniform … k' in it");
    EXPECT_EQ(written("#iUniform float", KnobType::float1, {9}), "there is no line '#iUniform … k' in it");
}

} // namespace tidemark::scene::knob_defaults_test
