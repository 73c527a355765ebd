// Values of knobs as text and as numbers, and knobs by name.
#include "scene/knob.hpp"
#include "support/naming.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

namespace tidemark::scene::knob_test {

std::string parsed(KnobType type, std::string_view text) {
    Knob knob;
    knob.name = "k";
    knob.type = type;
    const auto value = parse_knob_value(knob, text);
    if (value)
        return to_string(knob, *value);
    EXPECT_EQ(value.error().code, ErrorCode::usage);
    return value.error().message;
}

TEST(KnobValue, a_number) {
    EXPECT_EQ(parsed(KnobType::float1, "0.5"), "0.5");
    EXPECT_EQ(parsed(KnobType::float1, " -1e-3 "), "-0.001");
    EXPECT_EQ(parsed(KnobType::float1, "+2."), "2");
    EXPECT_EQ(parsed(KnobType::float1, ".5"), "0.5");
    EXPECT_EQ(parsed(KnobType::float1, "float(3)"), "3");
    EXPECT_EQ(parsed(KnobType::int1, "-3"), "-3");
    EXPECT_EQ(parsed(KnobType::int1, "1e3"), "1000");
    EXPECT_EQ(parsed(KnobType::int1, "int(3)"), "3");
}

TEST(KnobValue, the_default) {
    Knob knob{.name = "k", .initial = {0.25}, .value = {7}};
    EXPECT_EQ(parse_knob_value(knob, "default"), knob.initial);
}

TEST(KnobValue, the_last_setting_wins) {
    const Knob knob{.name = "k", .initial = {1}, .value = {2}};
    EXPECT_EQ(value_after(knob, {}), KnobValue{2});
    const std::vector<KnobSetting> settings{{"k", {1, {3}}}, {"other", {1, {4}}}, {"k", {1, {5}}}};
    EXPECT_EQ(value_after(knob, settings), KnobValue{5});
    EXPECT_EQ(value_after(knob, std::vector<KnobSetting>{{"k", {}}}), knob.initial);
}

/// Parses a text without its knob and prints it again, or returns the error.
std::string printed(std::string_view text) {
    const auto setting = parse_knob_setting("k", text);
    if (!setting)
        return setting.error().message;
    const auto again = parse_knob_setting("k", to_string(setting->value));
    EXPECT_EQ(again, *setting) << text;
    return to_string(setting->value);
}

TEST(GivenValue, is_printed_in_its_shortest_form) {
    EXPECT_EQ(printed(" 0.50 "), "0.5");
    EXPECT_EQ(printed("-1e-3"), "-0.001");
    EXPECT_EQ(printed("0.1"), "0.1");
    EXPECT_EQ(printed("1e22"), "1e+22");
    EXPECT_EQ(printed("1, 2,3"), "1,2,3");
    EXPECT_EQ(printed("ivec2( 1,2 )"), "ivec2(1, 2)");
    EXPECT_EQ(printed("vec3(1)"), "vec3(1)");
    EXPECT_EQ(printed("float(2)"), "float(2)");
    EXPECT_EQ(printed("#ff8000"), "color3(1, 0.5019607843137255, 0)");
    EXPECT_EQ(printed("default"), "default");
}

TEST(GivenValue, other_text_is_an_error_with_the_name_of_the_knob) {
    for (const std::string text :
         {"", "blue", "1,2,3,4,5", "nan", "inf", "1e999", "vec5(1)", "vec2(1", "vec2()", "#fff"})
        EXPECT_EQ(printed(text),
                  "'" + text +
                      "' is not a value for k: give a number, up to four as in 1,2,3, #rrggbb or "
                      "default");
}

TEST(GivenValue, prints_like_the_value_of_the_knob) {
    for (const char* name : {"float", "vec2", "vec3", "vec4", "color3", "int", "ivec2", "ivec3", "ivec4"}) {
        const Knob knob{.name = "k", .type = find_knob_type(name)->type};
        const KnobValue value{1, -2, 3, 4};
        const KnobSetting setting = setting_of(knob, value);
        EXPECT_EQ(setting.name, "k");
        EXPECT_EQ(to_string(setting.value), to_string(knob, value));
        const auto back = value_for(knob, setting.value);
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(to_string(knob, *back), to_string(knob, value));
        EXPECT_EQ(parse_knob_setting("k", to_string(knob, value)), setting);
    }
}

TEST(GivenValue, keeps_every_bit_of_a_number) {
    const Knob knob{.name = "k"};
    for (const double number : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0}) {
        const auto back = value_for(knob, parse_knob_setting("k", to_string(knob, {number}))->value);
        ASSERT_TRUE(back);
        EXPECT_EQ(std::bit_cast<uint64_t>((*back)[0]), std::bit_cast<uint64_t>(number));
    }
}

TEST(GivenValue, must_match_the_type_of_the_knob) {
    const auto refused = [](KnobType type, const GivenValue& given) {
        const auto value = value_for({.name = "k", .type = type}, given);
        return value ? "" : value.error().message;
    };
    EXPECT_EQ(refused(KnobType::vec3, {1, {2}}), "");
    EXPECT_THAT(refused(KnobType::float1, {2, {1, 2}}), naming("'1,2'", "(float)", "a number"));
    EXPECT_THAT(refused(KnobType::float1, {1, {HUGE_VAL}}), naming("'inf'", "(float)", "a number"));
    EXPECT_THAT(refused(KnobType::int1, {1, {1.5}}), naming("'1.5'", "(int)", "whole number"));
    EXPECT_THAT(refused(KnobType::int1, {1, {3e9}}), naming("'3000000000'", "(int)", "whole number"));
    EXPECT_THAT(refused(KnobType::ivec2, {2, {1, 2}, KnobType::vec2}),
                naming("'vec2(1, 2)'", "(ivec2)", "2 whole numbers"));
    EXPECT_EQ(refused(KnobType::color3, {3, {1, 2, 3}, KnobType::vec3}), "");
    EXPECT_THAT(refused(KnobType::vec3, {3, {1, 2, 3}, KnobType::color3}),
                naming("'color3(1, 2, 3)'", "(vec3)", "3 numbers"));
}

TEST(GivenValue, may_lie_outside_a_slider) {
    const Knob knob{.name = "k", .range = KnobRange{{0}, {2}}};
    EXPECT_EQ(value_for(knob, {1, {-5}}), KnobValue{-5});
}

TEST(SetKnob, refuses_invalid_values_and_keeps_the_old_value) {
    std::vector<Knob> knobs{{.name = "k", .value = {7}}};
    EXPECT_FALSE(set_knob(knobs, {"k", {2, {1, 2}}}));
    EXPECT_EQ(knobs[0].value, KnobValue{7});
    EXPECT_FALSE(set_knob(knobs, {"other", {1, {1}}}));
    EXPECT_TRUE(set_knob(knobs, {"k", {1, {3}}}));
    EXPECT_EQ(knobs[0].value, KnobValue{3});
}

TEST(KnobValue, a_list) {
    EXPECT_EQ(parsed(KnobType::vec2, "1,2"), "vec2(1, 2)");
    EXPECT_EQ(parsed(KnobType::vec3, " 1 , 2 , 3.5 "), "vec3(1, 2, 3.5)");
    EXPECT_EQ(parsed(KnobType::vec4, "1,2,3,4"), "vec4(1, 2, 3, 4)");
    EXPECT_EQ(parsed(KnobType::ivec2, "1,-2"), "ivec2(1, -2)");
    EXPECT_EQ(parsed(KnobType::ivec3, "1,2,3"), "ivec3(1, 2, 3)");
    EXPECT_EQ(parsed(KnobType::ivec4, "1,2,3,4"), "ivec4(1, 2, 3, 4)");
}

TEST(KnobValue, a_constructor) {
    EXPECT_EQ(parsed(KnobType::vec3, "vec3(1, 2, 3)"), "vec3(1, 2, 3)");
    EXPECT_EQ(parsed(KnobType::vec3, "vec3 ( 1 )"), "vec3(1, 1, 1)");
    EXPECT_EQ(parsed(KnobType::color3, "color3(1,2,3)"), "vec3(1, 2, 3)");
    EXPECT_EQ(parsed(KnobType::color3, "vec3(1,2,3)"), "vec3(1, 2, 3)");
    EXPECT_EQ(parsed(KnobType::ivec2, "ivec2(1,2)"), "ivec2(1, 2)");
}

TEST(KnobValue, one_number_sets_all_components) {
    EXPECT_EQ(parsed(KnobType::vec3, "2"), "vec3(2, 2, 2)");
    EXPECT_EQ(parsed(KnobType::ivec4, "2"), "ivec4(2, 2, 2, 2)");
}

TEST(KnobValue, a_colour) {
    EXPECT_EQ(parsed(KnobType::color3, "#ff8000"), "vec3(1, 0.5019607843137255, 0)");
    EXPECT_EQ(parsed(KnobType::color3, "#0000FF"), "vec3(0, 0, 1)");
    EXPECT_EQ(parsed(KnobType::color3, "0.5"), "vec3(0.5, 0.5, 0.5)");
}

TEST(KnobValue, invalid_numbers) {
    for (const std::string text : {"", " ", "x", "1x", "1,2", "nan", "inf", "1e999", "0x10", "1,", ",1",
                                   "--1", "+-1", "float(1", "float()", "vec2(1)", "#ffffff", "1 2"})
        EXPECT_EQ(parsed(KnobType::float1, text), "'" + std::string(text == " " ? "" : text) +
                                                      "' is not a value for k (float): give a number");
}

TEST(KnobValue, invalid_integers) {
    EXPECT_EQ(parsed(KnobType::int1, "2147483647"), "2147483647");
    EXPECT_EQ(parsed(KnobType::int1, "-2147483648"), "-2147483648");
    for (const std::string text : {"1.5", "2147483648", "-2147483649", "1e10", "x"})
        EXPECT_EQ(parsed(KnobType::int1, text),
                  "'" + text + "' is not a value for k (int): give a whole number");
}

TEST(KnobValue, invalid_vectors) {
    EXPECT_THAT(parsed(KnobType::vec2, "1,2,3"), naming("'1,2,3'", "(vec2)", "2 numbers"));
    EXPECT_THAT(parsed(KnobType::vec3, "1,2"), naming("'1,2'", "(vec3)", "3 numbers"));
    EXPECT_THAT(parsed(KnobType::vec4, "1,2,3,4,5"), naming("'1,2,3,4,5'", "(vec4)", "4 numbers"));
    EXPECT_THAT(parsed(KnobType::ivec2, "1,2.5"), naming("'1,2.5'", "(ivec2)", "2 whole numbers"));
}

TEST(KnobValue, invalid_colours) {
    for (const std::string text : {"#", "#fff", "#ff80000", "#gg8000", "#-f8000", "1,2"})
        EXPECT_EQ(parsed(KnobType::color3, text),
                  "'" + text + "' is not a value for k (color3): give 3 numbers, as in 1,2,3 or #rrggbb");
}

TEST(KnobType, converts_to_names_and_back) {
    for (const char* name : {"float", "vec2", "vec3", "vec4", "color3", "int", "ivec2", "ivec3", "ivec4"}) {
        const KnobTypeInfo* type = find_knob_type(name);
        ASSERT_TRUE(type) << name;
        EXPECT_EQ(type->directive_name, name);
        EXPECT_EQ(&info(type->type), type) << name;
    }
    EXPECT_EQ(info(KnobType::color3).glsl_name, "vec3");
    EXPECT_EQ(find_knob_type("bool"), nullptr);
}

TEST(FindKnob, by_name_or_with_a_hint) {
    std::vector<Knob> knobs(2);
    knobs[0].name = "wave_height";
    knobs[1].name = "fog";
    const auto message = [&](std::string_view name) {
        const auto found = find_knob(knobs, name);
        return found ? (*found)->name : found.error().message;
    };
    EXPECT_EQ(message("fog"), "fog");
    EXPECT_EQ(*find_knob(knobs, "fog"), &knobs[1]);
    EXPECT_EQ(message("wave_hight"), "the scene has no knob 'wave_hight': did you mean 'wave_height'?");
    EXPECT_EQ(message("speed"), "the scene has no knob 'speed': it has wave_height, fog");
    knobs.clear();
    EXPECT_EQ(message("fog"), "the scene has no knob 'fog': it declares none with #iUniform");
    EXPECT_EQ(find_knob(knobs, "fog").error().code, ErrorCode::usage);
}

} // namespace tidemark::scene::knob_test
