// The progress of a long command where standard error is no terminal.
#include "cli/progress.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

std::string printed(size_t total, size_t done) {
    testing::internal::CaptureStderr();
    {
        Progress progress("frames", total);
        for (size_t i = 0; i < done; ++i)
            progress.advance();
    }
    return testing::internal::GetCapturedStderr();
}

TEST(Progress, a_line_for_each_tenth) {
    for (const size_t total : {10u, 25u, 100u, 1001u}) {
        const std::string lines = printed(total, total);
        EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 10) << total;
        EXPECT_THAT(lines,
                    testing::HasSubstr(std::to_string(total) + "/" + std::to_string(total) + " frames, "));
        EXPECT_THAT(lines, testing::EndsWith(" a second, 0 s left\n"));
    }
}

TEST(Progress, a_line_for_each_of_a_few) {
    const std::string lines = printed(3, 3);
    EXPECT_THAT(lines, testing::StartsWith("1/3 frames, "));
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3);
}

TEST(Progress, one_thing_has_no_progress) {
    EXPECT_EQ(printed(1, 1), "");
    EXPECT_EQ(printed(0, 0), "");
    EXPECT_EQ(printed(100, 0), "");
}

} // namespace
} // namespace tidemark::cli
