#include "host/supervision.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace tidemark::host::interrupt_test {

bool comes_true(const std::function<bool()>& fact) {
    for (int i = 0; i < 1000 && !fact(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return fact();
}

/// The exit status of a child that runs `action`; -1 when it did not exit by itself.
template <class Action>
int status_of_child(const Action& action) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(20);
        action();
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Interrupt, is_not_requested_at_first) {
    const Interrupt interrupt;
    EXPECT_FALSE(interrupt.requested());
}

TEST(Interrupt, the_first_signal_requests_an_interrupt) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Interrupt interrupt;
        ::kill(::getpid(), signal);
        EXPECT_TRUE(comes_true([&] { return interrupt.requested(); }));
    }
}

TEST(Interrupt, a_waker_runs_only_during_its_lifetime) {
    static std::atomic<int> woken;
    woken = 0;
    Interrupt interrupt;
    {
        const Interrupt::Waking waking(interrupt, [] { ++woken; });
        ::kill(::getpid(), SIGINT);
        EXPECT_TRUE(comes_true([] { return woken == 1; }));
    }
    EXPECT_EQ(status_of_child([] {
                  Interrupt another;
                  {
                      const Interrupt::Waking past(another, [] { ::_exit(7); });
                  }
                  ::kill(::getpid(), SIGTERM);
                  comes_true([&] { return another.requested(); });
              }),
              0);
}

TEST(Interrupt, signals_of_other_threads_are_handled) {
    const Interrupt interrupt;
    std::thread worker([&] {
        ::kill(::getpid(), SIGINT);
        EXPECT_TRUE(comes_true([&] { return interrupt.requested(); }));
    });
    worker.join();
}

TEST(Interrupt, an_external_wake_up_signal_is_ignored) {
    const Interrupt interrupt;
    ::kill(::getpid(), SIGUSR1);
    ::kill(::getpid(), SIGINT);
    EXPECT_TRUE(comes_true([&] { return interrupt.requested(); }));
}

TEST(Interrupt, the_second_signal_ends_the_process) {
    EXPECT_EQ(status_of_child([] {
                  const Interrupt interrupt;
                  ::kill(::getpid(), SIGINT);
                  (void)comes_true([&] { return interrupt.requested(); });
                  ::kill(::getpid(), SIGINT);
                  (void)comes_true([] { return false; });
              }),
              130);
    EXPECT_EQ(Interrupt::k_exit_code, 130);
}

TEST(Interrupt, restores_the_signal_handlers) {
    sigset_t before, during, after;
    ::pthread_sigmask(SIG_SETMASK, nullptr, &before);
    {
        const Interrupt interrupt;
        ::pthread_sigmask(SIG_SETMASK, nullptr, &during);
    }
    ::pthread_sigmask(SIG_SETMASK, nullptr, &after);
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
        EXPECT_EQ(::sigismember(&during, signal), 1);
        EXPECT_EQ(::sigismember(&after, signal), ::sigismember(&before, signal));
    }
}

} // namespace tidemark::host::interrupt_test
