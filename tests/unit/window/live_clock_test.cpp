#include "window/frame_pacing.hpp"

#include <gtest/gtest.h>

namespace tidemark::render::live_clock_test {

constexpr double k_delta = 1 / 60.0;

TEST(LiveClock, starts_at_frame_0_and_time_0_whatever_the_clock_says) {
    LiveClock clock(1000);
    const FrameInputs first = inputs_of(clock.next_frame(1000));
    EXPECT_EQ(first.frame, 0);
    EXPECT_EQ(first.time, 0);
    EXPECT_EQ(first.time_delta, k_delta);
    EXPECT_EQ(first.frame_rate, 60);
}

TEST(LiveClock, runs_with_the_wall_clock) {
    LiveClock clock(1000);
    (void)clock.next_frame(1000.25);
    const FrameInputs second = inputs_of(clock.next_frame(1000.75));
    EXPECT_EQ(second.frame, 1);
    EXPECT_EQ(second.time, 0.75);
    EXPECT_EQ(second.time_delta, 0.5);
}

TEST(LiveClock, follows_frames_where_it_is_told_to) {
    LiveClock clock(1000, 25.0);
    (void)clock.next_frame(1000);
    const auto expect_frame = [&](int number) {
        const FrameInputs shown = inputs_of(clock.next_frame(1003.5 + number));
        const FrameInputs wanted = inputs_of_frame(number, 25);
        EXPECT_EQ(shown.frame, wanted.frame);
        EXPECT_EQ(shown.time, wanted.time);
        EXPECT_EQ(shown.time_delta, wanted.time_delta);
        EXPECT_EQ(shown.frame_rate, wanted.frame_rate);
    };
    expect_frame(1);
    expect_frame(2);
    clock.toggle_pause(1010);
    expect_frame(3); // drawn because somebody drags
    clock.step(-1, 25, 1011);
    expect_frame(2);
    clock.step(1, 25, 1012);
    EXPECT_EQ(clock.time(1020), 3 / 25.0);
    expect_frame(3);
    clock.restart(1020);
    expect_frame(0);
}

TEST(LiveClock, pause_freezes_time) {
    LiveClock clock(0);
    (void)clock.next_frame(1);
    EXPECT_FALSE(clock.paused());
    clock.toggle_pause(2);
    EXPECT_TRUE(clock.paused());
    const FrameInputs frozen = inputs_of(clock.next_frame(5));
    EXPECT_EQ(frozen.time, 2);
    EXPECT_EQ(frozen.time_delta, k_delta);
}

TEST(LiveClock, frames_drawn_in_a_pause_still_count) {
    LiveClock clock(0);
    (void)clock.next_frame(0);
    clock.toggle_pause(1);
    EXPECT_EQ(clock.next_frame(2).frame, 1);
    const FrameInputs later = inputs_of(clock.next_frame(9));
    EXPECT_EQ(later.frame, 2);
    EXPECT_EQ(later.time, 1);
    EXPECT_EQ(later.time_delta, k_delta) << "in every frame of the pause";
}

TEST(LiveClock, resumes_where_it_stood) {
    LiveClock clock(0);
    (void)clock.next_frame(1);
    clock.toggle_pause(2);
    (void)clock.next_frame(50);
    clock.toggle_pause(100);
    EXPECT_FALSE(clock.paused());
    const FrameInputs resumed = inputs_of(clock.next_frame(100.5));
    EXPECT_EQ(resumed.time, 2.5);
    EXPECT_EQ(resumed.time_delta, k_delta) << "the first frame after a pause";
    EXPECT_EQ(clock.next_frame(100.75).time_delta, 0.25);
}

TEST(LiveClock, a_rest_is_no_frames_delta) {
    LiveClock clock(0);
    (void)clock.next_frame(1);
    clock.rest();
    const FrameInputs woken = inputs_of(clock.next_frame(9));
    EXPECT_EQ(woken.time, 9) << "time goes on";
    EXPECT_EQ(woken.frame, 1);
    EXPECT_EQ(woken.time_delta, k_delta);
    EXPECT_EQ(woken.frame_rate, 60);
    EXPECT_EQ(clock.next_frame(9.25).time_delta, 0.25);
}

TEST(LiveClock, restart_begins_anew) {
    LiveClock clock(0);
    (void)clock.next_frame(1);
    (void)clock.next_frame(2);
    clock.restart(3);
    const FrameInputs first = inputs_of(clock.next_frame(3.5));
    EXPECT_EQ(first.frame, 0);
    EXPECT_EQ(first.time, 0.5);
    EXPECT_EQ(first.time_delta, k_delta);
}

TEST(LiveClock, restart_keeps_a_pause) {
    LiveClock clock(0);
    (void)clock.next_frame(1);
    clock.toggle_pause(2);
    clock.restart(3);
    EXPECT_TRUE(clock.paused());
    EXPECT_EQ(clock.next_frame(4).time, 0);
    clock.toggle_pause(5);
    EXPECT_EQ(clock.next_frame(6).time, 1);
}

TEST(LiveClock, a_step_pauses_and_goes_on_by_one_frame) {
    LiveClock clock(0);
    for (int i = 0; i < 3; ++i)
        (void)clock.next_frame(1);
    clock.step(1, 50, 1.5);
    EXPECT_TRUE(clock.paused());
    const FrameInputs next = inputs_of(clock.next_frame(7));
    EXPECT_EQ(next.frame, 3) << "frame 2 was on show";
    EXPECT_EQ(next.time, 1.52);
    EXPECT_EQ(next.time_delta, k_delta);
    clock.step(1, 50, 8);
    EXPECT_EQ(clock.next_frame(8).frame, 4);
}

TEST(LiveClock, a_step_back_shows_the_frame_before) {
    LiveClock clock(0);
    for (int i = 0; i < 3; ++i)
        (void)clock.next_frame(1);
    clock.step(-1, 50, 1.5);
    const FrameInputs back = inputs_of(clock.next_frame(7));
    EXPECT_EQ(back.frame, 1);
    EXPECT_EQ(back.time, 1.48);
}

TEST(LiveClock, no_step_goes_before_the_start) {
    LiveClock clock(0);
    (void)clock.next_frame(0);
    clock.step(-10, 50, 0.1);
    const FrameInputs first = inputs_of(clock.next_frame(1));
    EXPECT_EQ(first.frame, 0);
    EXPECT_EQ(first.time, 0);
}

TEST(LiveClock, the_rate_is_a_mean_over_half_a_second) {
    LiveClock clock(0);
    for (int i = 0; i < 50; ++i) // the last one at 0.49 s
        EXPECT_EQ(clock.next_frame(i * 0.01).fps, 60);
    EXPECT_NEAR(clock.next_frame(0.5).fps, 100, 1e-9);
    EXPECT_NEAR(clock.frame_rate(), 100, 1e-9);
    for (int i = 1; i < 10; ++i)
        EXPECT_NEAR(clock.next_frame(0.5 + i * 0.05).fps, 100, 1e-9);
    EXPECT_NEAR(clock.next_frame(1.0001).fps, 20, 0.01);
}

TEST(LiveClock, the_time_of_a_pause_is_no_part_of_the_rate) {
    LiveClock clock(0);
    for (int i = 0; i < 20; ++i)
        (void)clock.next_frame(i * 0.01);
    clock.toggle_pause(0.2);
    clock.toggle_pause(100);
    EXPECT_EQ(clock.next_frame(100).fps, 60);
    EXPECT_EQ(clock.next_frame(100.25).fps, 60);
    EXPECT_EQ(clock.next_frame(100.5).fps, 4);
}

TEST(LiveClock, goes_to_a_frame_and_on_from_there) {
    LiveClock clock(1000);
    (void)clock.next_frame(1000);
    clock.seek(5, 300, 1001);
    const FrameInputs there = inputs_of(clock.next_frame(1001));
    EXPECT_EQ(there.frame, 300);
    EXPECT_EQ(there.time, 5);
    EXPECT_EQ(there.time_delta, k_delta);
    EXPECT_EQ(inputs_of(clock.next_frame(1001.5)).time, 5.5);
}

TEST(LiveClock, runs_at_another_speed_and_back_to_0) {
    LiveClock clock(1000);
    clock.set_speed(2, 1001);
    EXPECT_EQ(clock.time(1002), 3);
    (void)clock.next_frame(1002);
    clock.set_speed(-1, 1002);
    const FrameInputs back = inputs_of(clock.next_frame(1002.5));
    EXPECT_EQ(back.time, 2.5);
    EXPECT_EQ(back.time_delta, 0.5);
    EXPECT_EQ(clock.time(1010), 0);
}

TEST(LiveClockTest, a_frame_that_is_given_back_was_none) {
    LiveClock clock(0);
    clock.next_frame(0);
    clock.next_frame(1);
    clock.give_frame_back();
    EXPECT_EQ(clock.next_frame_number(), 1);
    const FrameState next = clock.next_frame(3);
    EXPECT_EQ(next.frame, 1);
    EXPECT_EQ(next.seconds(), 3);
    EXPECT_EQ(next.time_delta, 1 / 60.0) << "as behind a rest";
    LiveClock counted(0, 10);
    counted.next_frame(0);
    counted.give_frame_back();
    EXPECT_EQ(counted.next_frame(0).seconds(), 0);
}

TEST(LiveClock, keeps_what_the_clock_does_not_set) {
    LiveClock clock(0);
    const FrameState state = clock.next_frame(0.5, {.frame = 7, .fps = 24, .bpm = 90});
    EXPECT_EQ(state.bpm, 90);
    EXPECT_EQ(state.frame, 0);
    EXPECT_EQ(state.fps, 60);
}

} // namespace tidemark::render::live_clock_test
