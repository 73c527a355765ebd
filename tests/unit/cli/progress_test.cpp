// The progress of a long command when standard error is not a terminal.
#include "host/console.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace tidemark::host::progress_test {

std::string printed(size_t total, size_t done, Progress::Manner manner = {.silent = 0}) {
    testing::internal::CaptureStderr();
    {
        Progress progress("frames", total, manner);
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

TEST(Progress, a_line_for_each_item_of_a_few) {
    const std::string lines = printed(3, 3);
    EXPECT_THAT(lines, testing::StartsWith("1/3 frames, "));
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3);
}

TEST(Progress, slow_tenths_print_lines_before_they_are_done) {
    const std::string lines = printed(100'000'000, 3, {.silent = 0, .between = 0});
    EXPECT_THAT(lines, testing::StartsWith("1/100000000 frames, "));
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3);
}

TEST(Progress, a_short_job_prints_no_progress) {
    EXPECT_EQ(printed(100, 100, {}), "");
}

TEST(Progress, uneven_pieces_have_no_rate) {
    EXPECT_THAT(printed(10, 1, {.silent = 0, .limit = 3600}),
                testing::MatchesRegex("1/10 frames, at most (3600|3599) s left\n"));
}

TEST(Progress, a_single_item_prints_no_progress) {
    EXPECT_EQ(printed(1, 1), "");
    EXPECT_EQ(printed(0, 0), "");
    EXPECT_EQ(printed(100, 0), "");
}

TEST(SlowNotice, is_printed_only_after_its_delay) {
    testing::internal::CaptureStderr();
    { const SlowNotice never("never", std::chrono::hours(1)); }
    {
        const SlowNotice at_once("compiling Image", std::chrono::milliseconds(0));
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "compiling Image\n");
}

} // namespace tidemark::host::progress_test
