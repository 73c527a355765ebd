// A full disk, for a piece of code alone.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <string>

namespace tidemark {

/// Runs `action` in a child with files limited to `limit` bytes; its message (one line) comes back.
template <class Action>
std::string in_limited_child(size_t limit, const Action& action) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit files{limit, limit};
        ::setrlimit(RLIMIT_FSIZE, &files);
        const std::string message = action();
        [[maybe_unused]] const ssize_t count = ::write(ends[1], message.data(), message.size());
        ::_exit(0);
    }
    ::close(ends[1]);
    std::string message(4096, '\0');
    message.resize(size_t(std::max<ssize_t>(0, ::read(ends[0], message.data(), message.size()))));
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    return message;
}

} // namespace tidemark
