#include "cli/capture_delivery.hpp"

#include <gtest/gtest.h>

#include <string>

namespace tidemark::cli::frame_records_test {

FrameRecord record(int frame, size_t not_finite, size_t no_coverage = 0) {
    return {.frame = frame,
            .file = std::to_string(frame) + ".png",
            .sha256 = {},
            .not_finite = not_finite,
            .no_coverage = no_coverage};
}

FrameRecords three(bool listed) {
    FrameRecords records(listed);
    records.add(record(4, 0));
    records.add(record(5, 7));
    records.add(record(6, 2, 1));
    return records;
}

TEST(FrameRecords, SummariseWithoutAList) {
    const FrameRecords records = three(false);
    EXPECT_EQ(records.count(), 3U);
    EXPECT_EQ(records.first().file, "4.png");
    EXPECT_EQ(records.last().file, "6.png");
    EXPECT_EQ(records.not_finite().count, 2U);
    EXPECT_EQ(records.not_finite().first->not_finite, 7U);
    EXPECT_EQ(records.no_coverage().count, 1U);
    EXPECT_EQ(records.no_coverage().first->frame, 6);
    EXPECT_TRUE(records.list().empty());
}

TEST(FrameRecords, ListAllFramesOnRequest) {
    ASSERT_EQ(three(true).list().size(), 3U);
    EXPECT_EQ(three(true).list()[1].frame, 5);
}

TEST(FrameRecords, WithoutFindingsTheCountsAreZero) {
    FrameRecords records(false);
    EXPECT_EQ(records.count(), 0U);
    records.add(record(0, 0));
    EXPECT_FALSE(records.not_finite().first);
}

} // namespace tidemark::cli::frame_records_test
