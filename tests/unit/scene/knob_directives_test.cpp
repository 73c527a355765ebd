// #iUniform: type, name, default, range and step of a knob.
#include "directives_support.hpp"
#include "support/naming.hpp"

#include <gtest/gtest.h>

namespace tidemark::scene::knob_directives_test {

Knob knob(std::string_view text) {
    const auto directives = read(text);
    EXPECT_TRUE(directives) << to_string(directives.error());
    return directives && directives->knobs.size() == 1 ? directives->knobs[0] : Knob{"not read"};
}

TEST(KnobDirectives, every_type_with_its_default) {
    struct Case {
        const char* text;
        KnobType type;
        KnobValue value;
    };
    for (const Case& wanted : {
             Case{"#iUniform float a = 1.5", KnobType::float1, {1.5}},
             Case{"#iUniform vec2 a = vec2(1.0, -2.0)", KnobType::vec2, {1, -2}},
             Case{"#iUniform vec3 a = vec3(1.0, 2.0, 3.0)", KnobType::vec3, {1, 2, 3}},
             Case{"#iUniform vec4 a = vec4(1, 2, 3, +4)", KnobType::vec4, {1, 2, 3, 4}},
             Case{"#iUniform color3 a = color3(1.0, 0.5, 0.25)", KnobType::color3, {1, 0.5, 0.25}},
             Case{"#iUniform int a = -7", KnobType::int1, {-7}},
             Case{"#iUniform ivec2 a = ivec2(1, 2)", KnobType::ivec2, {1, 2}},
             Case{"#iUniform ivec3 a = ivec3(1, 2, 3)", KnobType::ivec3, {1, 2, 3}},
             Case{"#iUniform ivec4 a = ivec4(1, 2, 3, 4)", KnobType::ivec4, {1, 2, 3, 4}},
         }) {
        const Knob read = knob(wanted.text);
        EXPECT_EQ(read.name, "a");
        EXPECT_EQ(read.type, wanted.type) << wanted.text;
        EXPECT_EQ(read.value, wanted.value) << wanted.text;
        EXPECT_EQ(read.initial, wanted.value) << wanted.text;
        EXPECT_FALSE(read.range);
        EXPECT_EQ(read.where, (SourceLocation{"dir/a.glsl", 1, 0}));
    }
}

TEST(KnobDirectives, one_number_sets_all_components) {
    EXPECT_EQ(knob("#iUniform vec3 a = 0.5").value, (KnobValue{0.5, 0.5, 0.5, 0}));
    EXPECT_EQ(knob("#iUniform color3 a = color3(1.0)").value, (KnobValue{1, 1, 1, 0}));
    EXPECT_EQ(knob("#iUniform vec2 a = float(2.0)").value, (KnobValue{2, 2, 0, 0}));
}

TEST(KnobDirectives, numbers_of_every_form) {
    EXPECT_EQ(knob("#iUniform float a = 1").value[0], 1);
    EXPECT_EQ(knob("#iUniform float a = 1.").value[0], 1);
    EXPECT_EQ(knob("#iUniform float a = .5").value[0], 0.5);
    EXPECT_EQ(knob("#iUniform float a = -1.5e-3").value[0], -1.5e-3);
    EXPECT_EQ(knob("#iUniform float a = 1E+2").value[0], 100);
}

TEST(KnobDirectives, ranges_in_either_bracket) {
    for (const char* text :
         {"#iUniform float a = 1.0 in { -1.0, 2.0 }", "#iUniform float a = 1.0 in [-1, 2]"}) {
        const Knob read = knob(text);
        ASSERT_TRUE(read.range);
        EXPECT_EQ(read.range->low, (KnobValue{-1}));
        EXPECT_EQ(read.range->high, (KnobValue{2}));
        EXPECT_FALSE(read.step);
    }
}

TEST(KnobDirectives, a_range_of_vectors_may_be_given_by_one_number) {
    const Knob read = knob("#iUniform vec3 a = 1.0 in { 0.0, vec3(1.0, 2.0, 3.0) }");
    ASSERT_TRUE(read.range);
    EXPECT_EQ(read.range->low, (KnobValue{0, 0, 0, 0}));
    EXPECT_EQ(read.range->high, (KnobValue{1, 2, 3, 0}));
}

TEST(KnobDirectives, default_is_the_low_end_of_the_range) {
    const Knob read = knob("#iUniform float a in { 0.25, 1.0 }");
    EXPECT_EQ(read.value, (KnobValue{0.25}));
    EXPECT_EQ(read.initial, (KnobValue{0.25}));
}

TEST(KnobDirectives, steps_are_parsed_and_integers_have_step_1) {
    EXPECT_EQ(knob("#iUniform float a = 1.0 in { 0.0, 2.0 } step 0.25").step, (KnobValue{0.25}));
    EXPECT_EQ(knob("#iUniform vec2 a = 1.0 step 0.5").step, (KnobValue{0.5, 0.5}));
    EXPECT_EQ(knob("#iUniform int a = 1").step, (KnobValue{1, 1, 1, 1}));
    EXPECT_EQ(knob("#iUniform int a = 1 step 2").step, (KnobValue{2}));
}

TEST(KnobDirectives, may_run_over_lines_and_around_comments) {
    const Knob read = knob("x;\n#iUniform // a knob\n  float\\\n a /* = 2.0 */ =\n 1.0\n in { 0.0,\n 2.0 }");
    EXPECT_EQ(read.value[0], 1);
    EXPECT_EQ(read.range->high[0], 2);
    EXPECT_EQ(read.where.line, 2);
}

TEST(KnobDirectives, keep_their_order) {
    const auto directives = read("#iUniform float b = 1 #iUniform int a = 2\n#iUniform vec2 c = 3");
    ASSERT_TRUE(directives);
    ASSERT_EQ(directives->knobs.size(), 3u);
    EXPECT_EQ(directives->knobs[0].name, "b");
    EXPECT_EQ(directives->knobs[1].name, "a");
    EXPECT_EQ(directives->knobs[2].name, "c");
}

TEST(KnobDirectives, duplicate_names_are_refused) {
    EXPECT_EQ(refusal("#iUniform float a = 1.0\n\n#iUniform int a = 1"),
              "dir/a.glsl:3: error: the knob 'a' is declared twice\n"
              "dir/a.glsl:1: note: first declared here");
}

TEST(KnobDirectives, unknown_types) {
    for (const std::string type : {"bool", "mat4", "uint", "Float", "7"})
        EXPECT_EQ(
            refusal("#iUniform " + type + " a = 1"),
            "dir/a.glsl:1:11: error: expected a type (float, vec2, vec3, vec4, color3, int, ivec2, ivec3 "
            "or ivec4) but found '" +
                type + "'");
}

TEST(KnobDirectives, without_default_and_range) {
    EXPECT_EQ(refusal("\n#iUniform float a\nfloat b;"),
              "dir/a.glsl:2: error: the knob 'a' needs a default (= VALUE) or a range (in { LOW, HIGH })");
    EXPECT_EQ(refusal("#iUniform float a step 1.0"),
              "dir/a.glsl:1: error: the knob 'a' needs a default (= VALUE) or a range (in { LOW, HIGH })");
}

TEST(KnobDirectives, values_of_another_type_are_refused) {
    EXPECT_THAT(refusal("#iUniform float a = vec2(1.0, 2.0)"),
                naming("dir/a.glsl:1:21: error:", "'a'", "one number"));
    EXPECT_EQ(refusal("#iUniform vec3 a = vec2(1.0, 2.0)"),
              "dir/a.glsl:1:20: error: 'a' is a vec3: it takes 3 numbers or one for all");
    for (const std::string number : {"1.0", "1e3", ".5"})
        EXPECT_THAT(refusal("#iUniform int a = " + number),
                    naming("dir/a.glsl:1:19: error:", "'a'", "whole numbers"));
    EXPECT_EQ(refusal("#iUniform ivec2 a = ivec2(1, 2.5)"),
              "dir/a.glsl:1:21: error: 'a' is an ivec2: it takes whole numbers");
    EXPECT_THAT(refusal("#iUniform int a = 1 in { 0, 2.0 }"),
                naming("dir/a.glsl:1:29: error:", "'a'", "whole numbers"));
}

TEST(KnobDirectives, whole_numbers_fit_an_int) {
    EXPECT_EQ(knob("#iUniform int a = 2147483647").value[0], 2147483647);
    EXPECT_EQ(knob("#iUniform int a = -2147483648").value[0], -2147483648.0);
    for (const std::string number : {"2147483648", "-2147483649", "100000000000000000000"})
        EXPECT_EQ(refusal("#iUniform int a = " + number),
                  "dir/a.glsl:1:19: error: 'a' is an int: " + number + " does not fit");
}

TEST(KnobDirectives, invalid_numbers) {
    EXPECT_THAT(refusal("#iUniform float a = b"), naming("dir/a.glsl:1:21: error:", "a number", "'b'"));
    EXPECT_THAT(refusal("#iUniform float a = -"),
                naming("dir/a.glsl:1:22: error:", "a number", "the end of the file"));
    for (const std::string number : {"1.0f", "0x10", "7u", "1e999"})
        EXPECT_EQ(refusal("#iUniform float a = " + number),
                  "dir/a.glsl:1:21: error: expected a decimal number but found '" + number + "'");
}

TEST(KnobDirectives, invalid_ranges) {
    EXPECT_EQ(refusal("#iUniform float a in 1.0"),
              "dir/a.glsl:1:22: error: expected '{' or '[' but found '1.0'");
    EXPECT_EQ(refusal("#iUniform float a in { 1.0 }"), "dir/a.glsl:1:28: error: expected ',' but found '}'");
    EXPECT_EQ(refusal("#iUniform float a in { 1.0, 2.0, 3.0 }"),
              "dir/a.glsl:1:32: error: expected '}' but found ','");
    EXPECT_EQ(refusal("#iUniform float a in { 1.0, 2.0 ]"),
              "dir/a.glsl:1:33: error: expected '}' but found ']'");
    EXPECT_EQ(refusal("#iUniform float a in [ 1.0, 2.0 }"),
              "dir/a.glsl:1:33: error: expected ']' but found '}'");
    EXPECT_THAT(refusal("#iUniform vec2 a in {\n vec2(0.0, 2.0), 1.0 }"),
                naming("dir/a.glsl:1:21: error:", "'a'", "reversed"));
}

TEST(KnobDirectives, an_unclosed_bracket_is_reported_at_its_place) {
    const std::string rest = "\n\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(a[0]); }\n";
    for (const char* open : {"in { 0.0, 2.0", "in { 0.0,", "in { 0.0", "in {"})
        EXPECT_EQ(refusal("\n#iUniform float a = 1.0 " + std::string(open) + rest),
                  "dir/a.glsl:2:28: error: '{' is not closed: '}' is missing")
            << open;
    EXPECT_EQ(refusal("#iUniform float a in [ 0.0, 2.0" + rest),
              "dir/a.glsl:1:22: error: '[' is not closed: ']' is missing");
    EXPECT_EQ(refusal("#iUniform vec2 a = vec2(1.0, 2.0" + rest),
              "dir/a.glsl:1:24: error: '(' is not closed: ')' is missing");
    EXPECT_EQ(refusal("#iUniform float a in { 0.0, 2.0\n#iUniform float b in { 0.0, 2.0 }\n"),
              "dir/a.glsl:1:22: error: '{' is not closed: '}' is missing");
    EXPECT_THAT(refusal("#iUniform float a in {\n0.0,\n  two\n}\n"),
                naming("dir/a.glsl:3:3: error:", "a number", "'two'"))
        << "one that is closed may take several lines";
}

TEST(KnobDirectives, missing_parts_are_reported) {
    EXPECT_THAT(refusal("#iUniform float = 1"),
                naming("dir/a.glsl:1:17: error:", "the name of the uniform", "'='"));
    EXPECT_THAT(refusal("#iUniform"), naming("dir/a.glsl:1:10: error:", "a type", "the end of the file"));
    EXPECT_EQ(refusal("#iUniform vec2 a = vec2 1"), "dir/a.glsl:1:25: error: expected '(' but found '1'");
    EXPECT_EQ(refusal("#iUniform vec2 a = vec2(1, 2;"), "dir/a.glsl:1:29: error: expected ')' but found ';'");
    EXPECT_THAT(refusal("#iUniform float a =\n\n;"),
                naming("dir/a.glsl:1:20: error:", "a number", "the end of the line"));
}

TEST(KnobDirectives, a_default_outside_of_its_range_is_refused) {
    EXPECT_EQ(refusal("\n#iUniform float a = 3.0 in { 0.0, 2.0 }"),
              "dir/a.glsl:2: error: the default of 'a' is 3, outside of its range 0 to 2");
}

TEST(KnobDirectives, a_misspelled_directive_suggests_the_correct_name) {
    EXPECT_EQ(refusal("#iUnifrom float a = 3.0"),
              "dir/a.glsl:1:1: error: there is no directive '#iUnifrom': did you mean '#iUniform'?");
    EXPECT_NE(refusal("#iChanel1 \"a.png\"").find("'#iChannel1'"), std::string::npos);
    EXPECT_EQ(refusal("#if 0\n#iUnifrom\n#endif"), "it was read");
    EXPECT_EQ(refusal("#ifdef A\n#endif\n#define iUnifrom 1"), "it was read");
}

} // namespace tidemark::scene::knob_directives_test
