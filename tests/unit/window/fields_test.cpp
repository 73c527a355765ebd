// Definitions, errors and time as the overlay's panels show them.
#include "host/overlay_fields.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace tidemark::overlay::fields_test {

std::string written(std::string_view text, double value) {
    auto field = definition_field("N", text, false);
    if (!field)
        return "none";
    field->value = value;
    return text_of(*field);
}

TEST(DefinitionField, keeps_integer_or_float) {
    EXPECT_EQ(written("8", 12), "12");
    EXPECT_EQ(written("-8", 3), "3");
    EXPECT_EQ(written("0.5", 3), "3.0");
    EXPECT_EQ(written("1e-3", 1e-7), "1e-07");
    EXPECT_EQ(written(".5", -0.25), "-0.25");
}

TEST(DefinitionField, requires_a_decimal_number) {
    for (const auto* text : {"8u", "0x10", "1.0f", "a", "", "1 + 2"})
        EXPECT_EQ(definition_field("N", text, false), std::nullopt) << text;
}

TEST(DefinitionField, value_is_kept_during_a_drag) {
    const std::vector<DefinitionField> before{{"A", 5, true, false, true}, {"B", 6, true, false, false}};
    std::vector<DefinitionField> now{{"B", 1, true}, {"A", 2, true}};
    keep_changing(before, now);
    EXPECT_EQ(now[0].value, 1);
    EXPECT_EQ(now[1].value, 5);
    EXPECT_TRUE(now[1].changing);
}

std::string excerpt(std::string_view line, int column, size_t most) {
    const Excerpt excerpt = excerpt_of(line, column, most);
    return excerpt.text + "\n" + excerpt.mark;
}

TEST(Excerpt, marks_the_place) {
    EXPECT_EQ(excerpt("\ta = b;", 6, 80), " a = b;\n     ^");
    EXPECT_EQ(excerpt("ä = b;", 6, 80), "ä = b;\n    ^") << "a column counts bytes, a mark characters";
    EXPECT_EQ(excerpt("a = b;", 0, 80), "a = b;\n");
    EXPECT_EQ(excerpt("a", 7, 80), "a\n ^");
    EXPECT_EQ(excerpt("", 1, 80), "\n^");
}

TEST(Excerpt, of_a_long_line_contains_the_place) {
    EXPECT_EQ(excerpt("0123456789abcdef", 13, 8), "89abcdef\n    ^");
    EXPECT_EQ(excerpt("0123456789abcdef", 3, 8), "01234567\n  ^");
}

TEST(Magnifier, prints_a_number_with_all_its_digits) {
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(number_text(1.0F / 3), "0.3333333");
    EXPECT_EQ(number_text(-1.5e-5F), "-1.5e-05");
    EXPECT_EQ(number_text(std::numeric_limits<float>::quiet_NaN()), "NaN");
    EXPECT_EQ(number_text(k_infinity), "Inf");
    EXPECT_EQ(number_text(-k_infinity), "-Inf");
    EXPECT_EQ(bits_text(1), "0x3f800000");
    EXPECT_EQ(bits_text(0), "0x00000000");
}

TEST(Magnifier, clamps_the_colour_to_the_display_range) {
    const std::array values{-1.0F, 0.5F, std::numeric_limits<float>::infinity()};
    EXPECT_EQ(colour_of(values.data()), (MagnifierField::Colour{0, 128, 255}));
}

TEST(TimeBar, doubles_when_time_reaches_its_end) {
    EXPECT_EQ(bar_end({.seconds = 0}), 10);
    EXPECT_EQ(bar_end({.seconds = 10.5}), 20);
    TimeField looped;
    looped.loop_to = 70;
    EXPECT_EQ(bar_end(looped), 80);
}

} // namespace tidemark::overlay::fields_test
