// Characters that would control a terminal are escaped; readable text stays.
#include "base/encoding.hpp"

#include <gtest/gtest.h>

#include <string>

namespace tidemark::printable_test {

TEST(Printable, texts_of_all_languages_stay) {
    for (const std::string text :
         {"", "plain", "two\nlines\tand a tab", "Größe, 水面, \U0001f30a, ꟻLIP", "a\\x1b"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, control_characters_are_escaped) {
    EXPECT_EQ(printable("\x1b[31mred\x1b]0;title\a"), "\\x1b[31mred\\x1b]0;title\\x07");
    EXPECT_EQ(printable(std::string("a\0b\r\b\x7f", 6)), "a\\x00b\\x0d\\x08\\u007f");
    EXPECT_EQ(printable("\u009b31m \u0085"), "\\u009b31m \\u0085"); // CSI in one character
    EXPECT_EQ(printable("a\u202eb\u2066c\u200fd\u2028"), "a\\u202eb\\u2066c\\u200fd\\u2028");
}

TEST(Printable, every_single_byte) {
    for (int i = 0; i < 256; ++i) {
        const std::string shown = printable(std::string(1, char(i)));
        for (const char c : shown)
            EXPECT_TRUE((c >= ' ' && c < 0x7f) || c == '\n' || c == '\t') << i;
    }
}

TEST(Printable, invalid_utf8_is_escaped) {
    EXPECT_EQ(printable("\xff\xc3(\xa9"), "\\xff\\xc3(\\xa9");
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");                   // ESC's neighbour, too long
    EXPECT_EQ(printable("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");          // CSI, too long
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");          // half of a pair of UTF-16
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80"); // beyond Unicode
    EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");                   // cut
}

TEST(Printable, invalid_utf8_is_replaced_by_valid_utf8) {
    EXPECT_EQ(valid_utf8("a\x1b\xc3\xa9\xff\xe2\x82"), "a\x1b\xc3\xa9\ufffd\ufffd\ufffd");
}

TEST(Printable, a_long_text_is_cut_between_characters) {
    EXPECT_EQ(cut_text("seven b", 7), "seven b");
    EXPECT_EQ(cut_text("eight by", 7), "eigh...");
    EXPECT_EQ(cut_text("\u00e9\u00e9\u00e9\u00e9", 6), "\u00e9...");
    EXPECT_EQ(cut_text(std::string(10, '\x80'), 6), "...");
}

TEST(Printable, printable_line_escapes_line_ends) {
    EXPECT_EQ(printable_line("two\nlines\t"), "two\\x0alines\\x09");
    EXPECT_TRUE(is_printable_line("é"));
    EXPECT_FALSE(is_printable_line("a\n"));
}

TEST(Characters, every_byte_of_one_leads_to_its_first_byte) {
    const std::string text = "a\u00e9\u20ac";
    const std::vector<size_t> begins{0, 1, 1, 3, 3, 3, 6};
    for (size_t at = 0; at < begins.size(); ++at) {
        EXPECT_EQ(begin_of_character(text, at), begins[at]) << at;
        if (at < text.size()) {
            EXPECT_EQ(continues_character(text[at]), begins[at] != at) << at;
        }
    }
    EXPECT_EQ(begin_of_character("\xa9\xa9", 1), 0U); // bytes that continue nothing
}

TEST(FloatLiteral, has_a_point_or_an_exponent) {
    EXPECT_EQ(float_literal("2"), "2.0");
    EXPECT_EQ(float_literal("-0.5"), "-0.5");
    EXPECT_EQ(float_literal("1e-07"), "1e-07");
}

} // namespace tidemark::printable_test
