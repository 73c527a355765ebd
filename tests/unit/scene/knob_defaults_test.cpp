// Values of knobs written into the lines that declare them.
#include "scene/knob.hpp"

#include <gtest/gtest.h>

namespace tidemark::scene::knob_defaults_test {

std::string written(std::string_view text, KnobType type, const KnobValue& value) {
    const auto changed = with_defaults(text, {Knob{.name = "k", .type = type, .value = value}});
    return changed ? *changed : changed.error().message;
}

TEST(KnobDefaults, replace_the_old_default) {
    EXPECT_EQ(written("#iUniform float k = 0.5 in { 0.0, 2.0 } step 0.1 // high\n", KnobType::float1, {1.25}),
              "#iUniform float k = 1.25 in { 0.0, 2.0 } step 0.1 // high\n");
    EXPECT_EQ(written("a\r\n#iUniform  float  k=-.5\r\nb", KnobType::float1, {-3}),
              "a\r\n#iUniform  float  k = -3\r\nb");
    EXPECT_EQ(written("#iUniform color3 k = color3(0.1, 0.2, 0.3)\nx", KnobType::color3, {1, 0.5, 0}),
              "#iUniform color3 k = color3(1, 0.5, 0)\nx");
    EXPECT_EQ(written("#iUniform ivec2 k = ivec2(\n1,\n2) in { 0, 9 }", KnobType::ivec2, {3, 4}),
              "#iUniform ivec2 k = ivec2(3, 4) in { 0, 9 }");
}

TEST(KnobDefaults, are_added_to_a_directive_without_a_default) {
    EXPECT_EQ(written("#iUniform int k in { 1, 9 }", KnobType::int1, {4}), "#iUniform int k = 4 in { 1, 9 }");
}

TEST(KnobDefaults, keep_other_knobs_and_comments) {
    const std::string text = "// #iUniform float k = 1.0\n#iUniform float kk = 2.0\n#iUniform float k = 3.0";
    EXPECT_EQ(written(text, KnobType::float1, {9}), text.substr(0, text.size() - 3) + "9");
}

TEST(KnobDefaults, report_missing_directives) {
    EXPECT_EQ(written("#iUniform float other = 1.0", KnobType::float1, {9}),
              "there is no line '#iUniform … k' in it");
    EXPECT_EQ(written("#iUniform float", KnobType::float1, {9}), "there is no line '#iUniform … k' in it");
}

TEST(KnobDefaults, of_plain_uniforms_have_the_declared_type) {
    const Knob flag{.name = "flip", .type = KnobType::int1, .value = {1}, .plain = true};
    EXPECT_EQ(with_defaults("uniform bool flip;\n", {flag}).value(), "uniform bool flip = true;\n");
    const Knob number{.name = "k", .value = {2}, .plain = true};
    EXPECT_EQ(with_defaults("uniform highp float a, k = 1.5;", {number}).value(),
              "uniform highp float a, k = 2.0;");
}

TEST(PlainKnobs, become_constants_of_their_declared_type) {
    const std::vector<Knob> knobs{
        {.name = "k", .value = {2}, .plain = true},
        {.name = "tint", .type = KnobType::vec3, .value = {0.5, 1, 0.25}, .plain = true},
        {.name = "flip", .type = KnobType::int1, .value = {0}, .plain = true},
        {.name = "other", .value = {3}}};
    const auto constants = [&](std::string_view text) { return with_plain_knobs_as_constants(text, knobs); };
    EXPECT_EQ(constants("uniform float k; // 0 2\nuniform vec3 tint = vec3(0.0);\n"),
              "const float k = 2.0; // 0 2\nconst vec3 tint = vec3(0.5, 1, 0.25);\n");
    EXPECT_EQ(constants("uniform mediump float k;\r\nuniform bool flip;"),
              "const mediump float k = 2.0;\r\nconst bool flip = false;");
    for (const char* text :
         {"uniform float iTime, k;", "layout(location = 3) uniform float k;", "uniform float k[2];",
          "uniform float other;", "// uniform float k;", "uniform float k"})
        EXPECT_EQ(constants(text), text);
}

} // namespace tidemark::scene::knob_defaults_test
