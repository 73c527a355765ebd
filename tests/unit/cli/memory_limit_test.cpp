#include "host/forked.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <vector>

namespace tidemark::host::memory_limit_test {

constexpr uint64_t k_gibi = uint64_t{1} << 30;

uint64_t parsed(std::string_view text) {
    const auto bytes = parse_memory(text, 8 * k_gibi);
    return bytes ? *bytes : 0;
}

TEST(MemoryLimit, Sizes) {
    EXPECT_EQ(parsed("2G"), 2 * k_gibi);
    EXPECT_EQ(parsed("512M"), k_gibi / 2);
    EXPECT_EQ(parsed("1.5GiB"), 3 * k_gibi / 2);
    EXPECT_EQ(parsed("64KB"), uint64_t{65536});
    EXPECT_EQ(parsed("1T"), 1024 * k_gibi);
    EXPECT_EQ(parsed("1000000"), uint64_t{1000000});
    EXPECT_EQ(parsed("50%"), 4 * k_gibi);
    EXPECT_EQ(parsed("12.5%"), k_gibi);
}

TEST(MemoryLimit, InvalidSizes) {
    for (const char* text :
         {"", "G", "2X", "2GG", "-1G", "0", "0%", "nan", "inf", "1e30", "2 G", "2G ", "%"}) {
        const auto bytes = parse_memory(text, k_gibi);
        ASSERT_FALSE(bytes) << text;
        EXPECT_EQ(bytes.error().code, ErrorCode::usage);
        EXPECT_EQ(bytes.error().message,
                  "--memory " + std::string(text) + ": give a size as in 512M, 2G or 50%");
    }
}

TEST(MemoryLimit, TextOfASize) {
    EXPECT_EQ(memory_text(k_gibi / 2), "512 MiB");
    EXPECT_EQ(memory_text(2 * k_gibi), "2 GiB");
    EXPECT_EQ(memory_text(k_gibi * 3 / 2), "1.5 GiB");
    EXPECT_EQ(memory_text(12 * k_gibi - 1), "12 GiB");
    EXPECT_EQ(memory_text(100), "100 bytes");
}

TEST(MemoryLimit, AMachineHasMemory) {
    EXPECT_GT(machine_memory(), uint64_t{1} << 20);
}

TEST(MemoryLimit, MemoryOfAProcessAndItsChildren) {
    constexpr size_t k_taken = 64 << 20;
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const pid_t grandchild = ::fork();
        std::vector<char> taken(k_taken, 1);
        (void)!::write(ready[1], taken.data(), 1);
        ::pause();
        ::_exit(int(grandchild & 1) + taken[5]);
    }
    char byte[2];
    ASSERT_EQ(::read(ready[0], byte, 1), 1);
    ASSERT_EQ(::read(ready[0], byte, 1), 1);
    const std::vector<pid_t> below = descendants_of(child);
    EXPECT_EQ(below.size(), 1U);
    EXPECT_TRUE(std::ranges::count(descendants_of(::getpid()), child));
    for (const pid_t process : {child, below.empty() ? child : below.front()}) {
        EXPECT_GE(memory_of(process), k_taken);
        EXPECT_LT(memory_of(process), 4 * k_taken);
    }
    for (const pid_t process : below)
        ::kill(process, SIGKILL);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(memory_of(child), 0U);
}

} // namespace tidemark::host::memory_limit_test
