#include "base/error.hpp"
#include "host/supervision.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

namespace tidemark::cli::watchdog_test {

using namespace std::chrono_literals;

TEST(Watchdog, work_that_ends_while_its_leavings_are_taken_down_does_not_go_on) {
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

TEST(Watchdog, work_in_time_is_left_alone) {
    EXPECT_EXIT(
        {
            Watchdog dog([] { ::_exit(1); });
            { const Watchdog::Watch watch(dog, {"drawing", 0.5}); }
            std::this_thread::sleep_for(700ms);
            ::_exit(0);
        },
        testing::ExitedWithCode(0), "");
}

TEST(Watchdog, work_that_nobody_wants_any_more_has_a_moment_to_end) {
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

} // namespace tidemark::cli::watchdog_test
