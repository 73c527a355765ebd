#include "base/error.hpp"
#include "host/supervision.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

namespace tidemark::host::watchdog_test {

using namespace std::chrono_literals;

TEST(Watchdog, work_that_ends_during_clean_up_does_not_continue) {
    EXPECT_EXIT(
        {
            Watchdog dog([] { std::this_thread::sleep_for(1s); });
            {
                const Watchdog::Watch watch(dog, {"drawing", 0.05});
                std::this_thread::sleep_for(1s);
            }
            ::_exit(1);
        },
        testing::ExitedWithCode(exit_code(ErrorCode::timed_out)), "stopped drawing after ");
}

TEST(Watchdog, work_within_its_limit_continues) {
    EXPECT_EXIT(
        {
            Watchdog dog([] { ::_exit(1); });
            { const Watchdog::Watch watch(dog, {"drawing", 0.5}); }
            std::this_thread::sleep_for(700ms);
            ::_exit(0);
        },
        testing::ExitedWithCode(0), "");
}

TEST(Watchdog, cancelled_work_gets_a_moment_to_end) {
    EXPECT_EXIT(
        {
            Watchdog dog;
            { // it ends by itself
                const Watchdog::Watch watch(
                    dog, {.what = "encoding", .limit_seconds = {}, .unwanted = [] { return true; }});
                std::this_thread::sleep_for(500ms);
            }
            const Watchdog::Watch watch(
                dog, {.what = "encoding", .limit_seconds = {}, .unwanted = [] { return true; }});
            std::this_thread::sleep_for(60s);
            ::_exit(1);
        },
        testing::ExitedWithCode(130), "stopped encoding after .* interrupted");
}

} // namespace tidemark::host::watchdog_test
