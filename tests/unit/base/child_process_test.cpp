#include "base/file.hpp"
#include "base/process.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <string>

extern "C" { // glibc 2.36 leaves it to us
#include <sys/pidfd.h>
}

namespace tidemark::child_process_test {

using namespace std::chrono_literals;

OutputLimits within(std::chrono::milliseconds time) {
    return {1000, ChildProcess::Clock::now() + time};
}

TEST(ChildProcess, output_and_errors_are_separate_and_no_shell_is_used) {
    const Result<std::string> output = output_of({"printf", "%s|", "a b", "$HOME", "*"}, {1000}, "");
    ASSERT_TRUE(output) << output.error().message;
    EXPECT_EQ(*output, "a b|$HOME|*|");
    Result<ChildProcess> child = ChildProcess::start({"sh", "-c", "echo words >&2; echo output; exit 3"},
                                                     ChildProcess::Input::none, "");
    ASSERT_TRUE(child);
    std::string words, text;
    std::array<std::byte, 3> block;
    for (size_t count; (count = child->read(block, words).value()) > 0;)
        text.append(reinterpret_cast<const char*>(block.data()), count);
    EXPECT_EQ(text, "output\n");
    EXPECT_EQ(words, "words\n");
    EXPECT_FALSE(child->succeeded());
}

TEST(ChildProcess, neither_pipe_blocks_the_other) {
    const Result<std::string> output =
        output_of({"sh", "-c",
                   "head -c 1000000 /dev/zero >&2; head -c 1000000 /dev/zero; head -c 1000000 /dev/zero >&2"},
                  {2000000}, "");
    ASSERT_TRUE(output) << output.error().message;
    EXPECT_EQ(output->size(), 1000000u);
}

TEST(ChildProcess, too_much_output_and_failure_are_errors) {
    EXPECT_EQ(output_of({"head", "-c", "3000000", "/dev/zero"}, {1 << 20}, "").error().message,
              "'head' prints more than 1 MiB");
    EXPECT_EQ(output_of({"sh", "-c", "echo one >&2; echo two >&2; false"}, {10}, "").error().message, "two");
    EXPECT_EQ(output_of({"no-such-program-here"}, {10}, ": get it").error().message,
              "there is no program 'no-such-program-here' in PATH: get it");
    EXPECT_EQ(output_of({"./none"}, {10}, ": get it").error().message,
              "there is no program './none': get it");
}

TEST(ChildProcess, has_a_time_limit_for_its_whole_output) {
    EXPECT_EQ(*output_of({"echo", "in time"}, within(60s), ""), "in time\n");
    // Silent; printing on and on; with its output closed.
    for (const char* script : {"sleep 600", "yes >&2", "exec >&- 2>&-; sleep 600"}) {
        const auto output = output_of({"sh", "-c", script}, within(100ms), "");
        ASSERT_FALSE(output) << script;
        EXPECT_EQ(output.error().code, ErrorCode::timed_out) << script;
        EXPECT_EQ(output.error().message, "the program that was started takes too long") << script;
    }
}

TEST(ChildProcess, grandchildren_end_with_the_child) {
    ChildProcess shell =
        *ChildProcess::start({"sh", "-c", "sleep 600 & echo $!; wait"}, ChildProcess::Input::none, "");
    std::string words;
    std::array<std::byte, 16> block;
    const size_t count = *shell.read(block, words);
    const pid_t sleeper = std::atoi(std::string(reinterpret_cast<const char*>(block.data()), count).c_str());
    const Descriptor watched(::pidfd_open(sleeper, 0));
    ASSERT_GE(watched.get(), 0);
    { const ChildProcess ended = std::move(shell); }
    pollfd ended = {watched.get(), POLLIN, 0};
    EXPECT_EQ(::poll(&ended, 1, 60000), 1);
}

} // namespace tidemark::child_process_test
