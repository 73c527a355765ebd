#include "base/supervision.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tidemark::doing_test {

class DoingTest : public testing::Test {
protected:
    void SetUp() override { Doing::note_on(page_); }
    void TearDown() override { Doing::note_on(nullptr); }

    DoingPage* page_ = DoingPage::make();
};

TEST_F(DoingTest, OuterActivityContinues) {
    EXPECT_EQ(page_->seen().what, "");
    {
        const Doing compiling("compiling Image");
        EXPECT_EQ(page_->seen().what, "compiling Image");
        EXPECT_FALSE(page_->seen().starting);
        {
            const Doing starting("starting", Doing::Kind::start);
            EXPECT_EQ(page_->seen().what, "starting");
            EXPECT_TRUE(page_->seen().starting);
        }
        EXPECT_EQ(page_->seen().what, "compiling Image");
        EXPECT_FALSE(page_->seen().starting);
    }
    EXPECT_EQ(page_->seen().what, "");
}

TEST_F(DoingTest, OutlivesTheProcessThatCrashes) {
    const pid_t child = ::fork();
    if (child == 0) {
        const Doing compiling("compiling Buffer A");
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(page_->seen().what, "compiling Buffer A");
}

TEST_F(DoingTest, ActivityOfADeadProcessIsReportedOnce) {
    if (const pid_t child = ::fork(); child == 0) {
        const Doing compiling("compiling Buffer A");
        ::_exit(0);
    } else {
        ::waitpid(child, nullptr, 0);
    }
    EXPECT_EQ(Doing::left_behind(), "compiling Buffer A");
    EXPECT_EQ(Doing::left_behind(), "");
    EXPECT_EQ(page_->seen().what, "");
}

TEST_F(DoingTest, LongTextsAreCut) {
    const Doing compiling(std::string(100000, 'x'));
    EXPECT_EQ(page_->seen().what.find_first_not_of('x'), std::string::npos);
    EXPECT_GT(page_->seen().what.size(), 100U);
}

TEST_F(DoingTest, StartOfTheDriverIsKept) {
    { const Doing compiling("compiling"); }
    EXPECT_FALSE(page_->has_driver());
    { const Doing starting("starting", Doing::Kind::start); }
    EXPECT_TRUE(page_->has_driver());
}

TEST_F(DoingTest, CurrentFrame) {
    EXPECT_FALSE(page_->frame());
    EXPECT_FALSE(page_->resumable());
    if (const pid_t child = ::fork(); child == 0) {
        Doing::note_frame(DoingPage::Frame{-7, true});
        Doing::note_resumable();
        ::_exit(0);
    } else {
        ::waitpid(child, nullptr, 0);
    }
    ASSERT_TRUE(page_->frame());
    EXPECT_EQ(page_->frame()->number, -7);
    EXPECT_TRUE(page_->frame()->begun);
    EXPECT_TRUE(page_->resumable());
    Doing::note_frame({});
    EXPECT_FALSE(page_->frame());
}

TEST_F(DoingTest, WithoutAPageNothingIsNoted) {
    Doing::note_on(nullptr);
    const Doing compiling("compiling");
    EXPECT_EQ(page_->seen().what, "");
}

} // namespace tidemark::doing_test
