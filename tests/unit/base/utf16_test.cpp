#include "base/tokens.hpp"

#include <gtest/gtest.h>

namespace tidemark::text::utf16_test {

struct Case {
    std::string_view text;
    size_t units;
};

constexpr Case k_cases[] = {
    {"", 0},
    {"abc", 3},
    {"\u00e9", 1},
    {"\u20ac", 1},
    {"\U0001F30A", 2},
    {"a\U0001F30Ab", 4},
    {"\xff\xfe", 2},     // no UTF-8: a unit each
    {"\xe2\x82", 2},     // cut short
    {"\xe2\x82\x28", 3}, // begun and not gone on with
    {"\xf9\x80\x80", 3}, // longer than there are
};

TEST(Utf16, length_is_that_of_the_encoding) {
    for (const Case& each : k_cases)
        EXPECT_EQ(utf16_length(each.text), each.units) << each.text;
}

TEST(Utf16, byte_offset_inverts_the_length) {
    for (const Case& each : k_cases) {
        EXPECT_EQ(bytes_of_utf16(each.text, each.units), each.text.size()) << each.text;
        EXPECT_EQ(bytes_of_utf16(each.text, each.units + 5), each.text.size()) << each.text;
    }
}

TEST(Utf16, a_character_is_never_split) {
    EXPECT_EQ(bytes_of_utf16("\U0001F30Ab", 1), 0u);
    EXPECT_EQ(bytes_of_utf16("\U0001F30Ab", 2), 4u);
}

} // namespace tidemark::text::utf16_test
