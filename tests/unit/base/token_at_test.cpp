#include "base/tokens.hpp"

#include <gtest/gtest.h>

namespace tidemark::text::token_at_test {

TEST(TokenAt, lines_count_from_1) {
    EXPECT_EQ(line_of("a\nbc\n", 1), "a");
    EXPECT_EQ(line_of("a\nbc\n", 2), "bc");
    EXPECT_EQ(line_of("a\nbc\n", 3), "");
    EXPECT_EQ(line_of("a\nbc\n", 9), "");
}

TEST(TokenAt, ends_where_the_token_ends) {
    EXPECT_EQ(end_of_token("  thrice(1.5)", 3), 9);
    EXPECT_EQ(end_of_token("  thrice(1.5)", 9), 10);
    EXPECT_EQ(end_of_token("  thrice(1.5)", 10), 13);
}

TEST(TokenAt, no_token_has_no_end) {
    EXPECT_EQ(end_of_token("  a", 1), 0);
    EXPECT_EQ(end_of_token("  a", 0), 0);
    EXPECT_EQ(end_of_token("  a", 4), 0);
    EXPECT_EQ(end_of_token("// a", 1), 0);
}

} // namespace tidemark::text::token_at_test
