#include "base/supervision.hpp"
#include "host/forked.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <vector>

namespace tidemark::host::forked_test {

Result<ForkedHelper> echo() {
    return ForkedHelper::start([](const std::string& question, const Tell& tell) {
        tell("asked: " + question);
        tell(question == "crash" ? "before" : "done");
        if (question == "crash")
            ::raise(SIGKILL);
        if (question == "sleep")
            ::sleep(60);
    });
}

TEST(Forked, OutputIsReturned) {
    const auto run = run_forked([](const Tell& tell) { tell("one"), tell("two"); }, {60});
    ASSERT_TRUE(run);
    EXPECT_EQ(run->output, "one\ntwo\n");
    EXPECT_EQ(run->crash, "");
    EXPECT_FALSE(run->timed_out);
}

TEST(Forked, AHelperAnswersRequests) {
    auto helper = echo();
    ASSERT_TRUE(helper);
    const auto run = helper->ask("how deep?", {60});
    ASSERT_TRUE(run);
    EXPECT_EQ(run->output, "asked: how deep?\ndone\n");
}

TEST(Forked, MemoryHasALimit) {
    const auto run = run_forked(
        [](const Tell& tell) {
            tell("before");
            std::vector<char> much(size_t{200} << 20, 1);
            ::sleep(60);
            tell(std::string(1, much[7]));
        },
        {.seconds = 60, .memory = uint64_t{100} << 20});
    ASSERT_TRUE(run);
    EXPECT_TRUE(run->over_memory);
    EXPECT_FALSE(run->timed_out);
    EXPECT_EQ(run->output, "before\n");
}

TEST(Forked, UnwantedWorkIsEnded) {
    int asked = 0;
    const auto run = run_forked([](const Tell&) { ::sleep(60); },
                                {.seconds = 60, .unwanted = [&] { return ++asked == 3; }});
    ASSERT_TRUE(run);
    EXPECT_TRUE(run->unwanted);
    EXPECT_EQ(run->crash, "");
}

TEST(Forked, CrashNamesTheDriverCall) {
    Doing::note_on(DoingPage::make());
    const auto run = run_forked(
        [](const Tell&) {
            const Doing compiling("compiling Image");
            ::raise(SIGKILL);
        },
        {60});
    Doing::note_on(nullptr);
    ASSERT_TRUE(run);
    EXPECT_EQ(run->crash, "the driver crashed (SIGKILL) compiling Image");
    EXPECT_EQ(run->doing, "compiling Image");
}

TEST(Forked, ExitOfTheProcessIsReported) {
    const auto run = run_forked([](const Tell&) { ::_exit(66); }, {60});
    ASSERT_TRUE(run);
    EXPECT_EQ(run->crash, "the driver ended the process (exit code 66)");
    EXPECT_EQ(run_forked([](const Tell&) {}, {60})->crash, "");
}

TEST(Forked, ACrashingHelperIsReported) {
    auto helper = echo();
    const auto run = helper->ask("crash", {60});
    ASSERT_TRUE(run);
    EXPECT_EQ(run->output, "asked: crash\nbefore\n");
    EXPECT_EQ(run->crash, "the driver crashed (SIGKILL)");
}

TEST(Forked, AHelperHasATimeLimit) {
    auto helper = echo();
    const auto run = helper->ask("sleep", {0.2});
    ASSERT_TRUE(run);
    EXPECT_TRUE(run->timed_out);
    EXPECT_EQ(run->output, "asked: sleep\ndone\n");
}

TEST(Forked, AnUnusedHelperEnds) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    {
        auto helper = ForkedHelper::start([](const std::string&, const Tell&) {});
        ASSERT_TRUE(helper);
        ::close(ends[1]); // the helper has the last one
    }
    char byte = 0;
    EXPECT_EQ(::read(ends[0], &byte, 1), 0);
    ::close(ends[0]);
}

} // namespace tidemark::host::forked_test
