#include "base/extent.hpp"

#include <gtest/gtest.h>

namespace tidemark::extent_test {

TEST(Extent, width_and_height_by_an_x) {
    const auto extent = parse_extent("640x360");
    ASSERT_TRUE(extent);
    EXPECT_EQ(extent->width, 640);
    EXPECT_EQ(extent->height, 360);
    EXPECT_TRUE(parse_extent("1x1"));
}

TEST(Extent, other_forms_are_refused) {
    for (const char* text : {"", "x", "640", "640x", "x360", "0x1", "1x0", "-1x1", "+1x1", "640X360",
                             "640 x 360", "640x360x2", "640x360 ", "6e2x360", "99999999999x1"})
        EXPECT_FALSE(parse_extent(text)) << text;
}

TEST(Rectangle, left_bottom_width_and_height) {
    EXPECT_EQ(parse_rectangle("100,50,320,180"), (Rectangle{100, 50, {320, 180}}));
    EXPECT_EQ(parse_rectangle("-1,0,1,1"), (Rectangle{-1, 0, {1, 1}}));
    EXPECT_EQ(to_string(Rectangle{100, 50, {320, 180}}), "100,50,320,180");
}

TEST(Rectangle, other_forms_are_refused) {
    for (const char* text :
         {"", "1", "1,2", "1,2,3", "1,2,3,", "1,2,3,4,", "1,2,3,4,5", "1,2,3x4", "1, 2,3,4", "1,2,0,4",
          "1,2,3,-4", "a,2,3,4", "1.5,2,3,4", ",1,2,3,4", "1,2,3,99999999999"})
        EXPECT_FALSE(parse_rectangle(text)) << text;
}

} // namespace tidemark::extent_test
