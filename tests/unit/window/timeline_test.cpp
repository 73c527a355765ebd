#include "window/timeline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tidemark::window::timeline_test {

using namespace host;

using render::FrameInputs;
using render::FrameState;
using render::inputs_of;
using render::inputs_of_frame;

constexpr double k_delta = 1 / 60.0;

TEST(Timeline, starts_at_frame_0_and_time_0_for_any_clock) {
    Timeline clock(1000);
    const FrameInputs first = inputs_of(clock.next_frame(1000));
    EXPECT_EQ(first.frame, 0);
    EXPECT_EQ(first.time, 0);
    EXPECT_EQ(first.time_delta, k_delta);
    EXPECT_EQ(first.frame_rate, 60);
}

TEST(Timeline, runs_with_the_wall_clock) {
    Timeline clock(1000);
    (void)clock.next_frame(1000.25);
    const FrameInputs second = inputs_of(clock.next_frame(1000.75));
    EXPECT_EQ(second.frame, 1);
    EXPECT_EQ(second.time, 0.75);
    EXPECT_EQ(second.time_delta, 0.5);
}

TEST(Timeline, counts_frames_if_configured) {
    Timeline clock(1000, 25, Timeline::Source::frames);
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
    expect_frame(3); // drawn during a drag
    clock.step(-1, 1011);
    expect_frame(2);
    clock.step(1, 1012);
    EXPECT_EQ(clock.time(1020), 3 / 25.0);
    expect_frame(3);
    clock.restart(1020);
    expect_frame(0);
}

TEST(Timeline, pause_freezes_time) {
    Timeline clock(0);
    (void)clock.next_frame(1);
    EXPECT_FALSE(clock.paused());
    clock.toggle_pause(2);
    EXPECT_TRUE(clock.paused());
    const FrameInputs frozen = inputs_of(clock.next_frame(5));
    EXPECT_EQ(frozen.time, 2);
    EXPECT_EQ(frozen.time_delta, k_delta);
}

TEST(Timeline, frames_drawn_in_a_pause_still_count) {
    Timeline clock(0);
    (void)clock.next_frame(0);
    clock.toggle_pause(1);
    EXPECT_EQ(clock.next_frame(2).frame, 1);
    const FrameInputs later = inputs_of(clock.next_frame(9));
    EXPECT_EQ(later.frame, 2);
    EXPECT_EQ(later.time, 1);
    EXPECT_EQ(later.time_delta, k_delta) << "in every frame of the pause";
}

TEST(Timeline, resumes_where_it_stood) {
    Timeline clock(0);
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

TEST(Timeline, a_rest_does_not_count_in_the_delta) {
    Timeline clock(0);
    (void)clock.next_frame(1);
    clock.rest();
    const FrameInputs woken = inputs_of(clock.next_frame(9));
    EXPECT_EQ(woken.time, 9) << "time goes on";
    EXPECT_EQ(woken.frame, 1);
    EXPECT_EQ(woken.time_delta, k_delta);
    EXPECT_EQ(woken.frame_rate, 60);
    EXPECT_EQ(clock.next_frame(9.25).time_delta, 0.25);
}

TEST(Timeline, restart_resets_frame_and_time) {
    Timeline clock(0);
    (void)clock.next_frame(1);
    (void)clock.next_frame(2);
    clock.restart(3);
    const FrameInputs first = inputs_of(clock.next_frame(3.5));
    EXPECT_EQ(first.frame, 0);
    EXPECT_EQ(first.time, 0.5);
    EXPECT_EQ(first.time_delta, k_delta);
}

TEST(Timeline, restart_keeps_a_pause) {
    Timeline clock(0);
    (void)clock.next_frame(1);
    clock.toggle_pause(2);
    clock.restart(3);
    EXPECT_TRUE(clock.paused());
    EXPECT_EQ(clock.next_frame(4).time, 0);
    clock.toggle_pause(5);
    EXPECT_EQ(clock.next_frame(6).time, 1);
}

TEST(Timeline, a_step_pauses_and_advances_one_frame) {
    Timeline clock(0, 50);
    for (int i = 0; i < 3; ++i)
        (void)clock.next_frame(1);
    clock.step(1, 1.5);
    EXPECT_TRUE(clock.paused());
    const FrameInputs next = inputs_of(clock.next_frame(7));
    EXPECT_EQ(next.frame, 3) << "frame 2 was on show";
    EXPECT_EQ(next.time, 1.52);
    EXPECT_EQ(next.time_delta, k_delta);
    clock.step(1, 8);
    EXPECT_EQ(clock.next_frame(8).frame, 4);
}

TEST(Timeline, a_step_back_shows_the_frame_before) {
    Timeline clock(0, 50);
    for (int i = 0; i < 3; ++i)
        (void)clock.next_frame(1);
    clock.step(-1, 1.5);
    const FrameInputs back = inputs_of(clock.next_frame(7));
    EXPECT_EQ(back.frame, 1);
    EXPECT_EQ(back.time, 1.48);
}

TEST(Timeline, steps_end_at_the_start) {
    Timeline clock(0, 50);
    (void)clock.next_frame(0);
    clock.step(-10, 0.1);
    const FrameInputs first = inputs_of(clock.next_frame(1));
    EXPECT_EQ(first.frame, 0);
    EXPECT_EQ(first.time, 0);
}

TEST(Timeline, the_rate_is_a_mean_over_half_a_second) {
    Timeline clock(0);
    for (int i = 0; i < 50; ++i) // the last one at 0.49 s
        EXPECT_EQ(clock.next_frame(i * 0.01).fps, 60);
    EXPECT_NEAR(clock.next_frame(0.5).fps, 100, 1e-9);
    EXPECT_NEAR(clock.frame_rate(), 100, 1e-9);
    for (int i = 1; i < 10; ++i)
        EXPECT_NEAR(clock.next_frame(0.5 + i * 0.05).fps, 100, 1e-9);
    EXPECT_NEAR(clock.next_frame(1.0001).fps, 20, 0.01);
}

TEST(Timeline, the_time_of_a_pause_does_not_count_in_the_rate) {
    Timeline clock(0);
    for (int i = 0; i < 20; ++i)
        (void)clock.next_frame(i * 0.01);
    clock.toggle_pause(0.2);
    clock.toggle_pause(100);
    EXPECT_EQ(clock.next_frame(100).fps, 60);
    EXPECT_EQ(clock.next_frame(100.25).fps, 60);
    EXPECT_EQ(clock.next_frame(100.5).fps, 4);
}

TEST(Timeline, a_seek_continues_from_its_frame) {
    Timeline clock(1000);
    (void)clock.next_frame(1000);
    clock.seek(5, 300, 1001);
    const FrameInputs there = inputs_of(clock.next_frame(1001));
    EXPECT_EQ(there.frame, 300);
    EXPECT_EQ(there.time, 5);
    EXPECT_EQ(there.time_delta, k_delta);
    EXPECT_EQ(inputs_of(clock.next_frame(1001.5)).time, 5.5);
}

TEST(Timeline, runs_at_another_speed_and_back_to_0) {
    Timeline clock(1000);
    clock.set_speed(2, 1001);
    EXPECT_EQ(clock.time(1002), 3);
    (void)clock.next_frame(1002);
    clock.set_speed(-1, 1002);
    const FrameInputs back = inputs_of(clock.next_frame(1002.5));
    EXPECT_EQ(back.time, 2.5);
    EXPECT_EQ(back.time_delta, 0.5);
    EXPECT_EQ(clock.time(1010), 0);
}

TEST(Timeline, a_returned_frame_is_not_counted) {
    Timeline clock(0);
    clock.next_frame(0);
    clock.next_frame(1);
    clock.give_frame_back();
    EXPECT_EQ(clock.next_frame_number(), 1);
    const FrameState next = clock.next_frame(3);
    EXPECT_EQ(next.frame, 1);
    EXPECT_EQ(next.seconds(), 3);
    EXPECT_EQ(next.time_delta, 1 / 60.0) << "as behind a rest";
    Timeline counted(0, 10, Timeline::Source::frames);
    counted.next_frame(0);
    counted.give_frame_back();
    EXPECT_EQ(counted.next_frame(0).seconds(), 0);
}

TEST(Timeline, keeps_settings_independent_of_the_clock) {
    Timeline clock(0);
    const FrameState state = clock.next_frame(0.5, {.frame = 7, .fps = 24, .bpm = 90});
    EXPECT_EQ(state.bpm, 90);
    EXPECT_EQ(state.frame, 0);
    EXPECT_EQ(state.fps, 60);
}

TEST(Timeline, finds_the_frame_at_a_time) {
    const Timeline clock(0, 25);
    EXPECT_EQ(clock.frame_at(0), 0);
    EXPECT_EQ(clock.frame_at(2), 50);
    EXPECT_EQ(clock.frame_at(-0.1), std::nullopt);
    EXPECT_EQ(clock.frame_at(std::nan("")), std::nullopt);
    EXPECT_EQ(clock.frame_at(1e9), std::nullopt) << "beyond the last frame";
}

TEST(Timeline, a_seek_keeps_a_pause) {
    Timeline clock(0, 50);
    clock.toggle_pause(1);
    clock.seek(7, 350, 2);
    EXPECT_TRUE(clock.paused());
    EXPECT_EQ(clock.time(20), 7);
    EXPECT_EQ(clock.next_frame(20).frame, 350);
}

TEST(Timeline, stays_at_the_frame_where_a_seek_was_cancelled) {
    Timeline clock(0, 50);
    clock.pause_at(75, 3);
    EXPECT_TRUE(clock.paused());
    EXPECT_EQ(clock.time(9), 1.5);
    clock.pause_at(100, 4);
    EXPECT_TRUE(clock.paused()) << "a second one does not resume";
    EXPECT_EQ(clock.next_frame(9).frame, 100);
}

TEST(Timeline, jumps_to_the_start_of_the_loop_at_its_end) {
    Timeline clock(0);
    EXPECT_EQ(clock.loop_jump(5), std::nullopt);
    clock.set_loop({.from = 1, .to = 3});
    EXPECT_EQ(clock.loop_jump(0.5), std::nullopt) << "before the loop it runs into it";
    EXPECT_EQ(clock.loop_jump(2.9), std::nullopt);
    EXPECT_EQ(clock.loop_jump(3), 1);
    clock.seek(3.5, 0, 3);
    EXPECT_EQ(clock.loop_jump(3), 1);
}

TEST(Timeline, a_loop_backwards_jumps_to_its_end) {
    Timeline clock(0);
    clock.set_loop({.from = 1, .to = 3});
    clock.seek(2, 0, 0);
    clock.set_speed(-1, 0);
    EXPECT_EQ(clock.loop_jump(0.5), std::nullopt);
    EXPECT_EQ(clock.loop_jump(1), 3);
}

TEST(Timeline, a_loop_needs_two_ends_in_order) {
    Timeline clock(0);
    for (const overlay::SetLoop& none :
         {overlay::SetLoop{.from = 1}, {.to = 1}, {.from = 2, .to = 1}, {1, 1}}) {
        clock.set_loop(none);
        EXPECT_EQ(clock.loop_jump(5), std::nullopt);
    }
}

TEST(Timeline, time_without_a_viewer_does_not_count_in_the_delta) {
    Timeline clock(0);
    (void)clock.next_frame(1);
    clock.watch(false, 1);
    clock.watch(false, 1.5);
    clock.watch(true, 1.75);
    EXPECT_EQ(clock.next_frame(1.75).time_delta, 0.75) << "half a second is too short to be left out";
    clock.watch(false, 2);
    clock.watch(true, 9);
    EXPECT_EQ(clock.next_frame(9).time_delta, k_delta);
}

TEST(Timeline, restarts_with_the_first_picture) {
    Timeline clock(0, 50);
    clock.set_loop({.from = 1, .to = 3});
    clock.begin_next_scene_at(2);
    clock.set_speed(4, 1);
    clock.toggle_pause(1);
    clock.begin(10);
    EXPECT_FALSE(clock.paused());
    EXPECT_EQ(clock.speed(), 1);
    EXPECT_EQ(clock.time(10.5), 0.5);
    EXPECT_EQ(clock.loop_jump(13), 1) << "the loop stays";
    EXPECT_EQ(clock.take_next_scene_time(), 2);
    EXPECT_EQ(clock.take_next_scene_time(), std::nullopt) << "once";
}

TEST(Timeline, the_range_of_the_bar_is_fixed_while_dragging) {
    Timeline clock(0);
    const auto end_at = [&](double seconds) { return clock.field({.time = seconds}).bar_end; };
    EXPECT_EQ(end_at(200), 320);
    clock.hold_bar(200);
    clock.fit_bar();
    EXPECT_EQ(end_at(144), 320) << "dragged to the left";
    EXPECT_EQ(end_at(500), 320) << "time went on while it was pressed";
    EXPECT_TRUE(clock.field({}).bar_held);
    clock.release_bar();
    EXPECT_EQ(end_at(4), 320) << "the next press meets the same bar";
    EXPECT_EQ(end_at(500), 640);
    clock.fit_bar();
    EXPECT_EQ(end_at(4), 10);
}

TEST(Timeline, the_bar_grows_until_the_next_restart) {
    Timeline clock(0);
    clock.grow_bar(3);
    clock.grow_bar(3);
    EXPECT_EQ(clock.field({.time = 3}).bar_end, 40);
    clock.restart(1);
    EXPECT_EQ(clock.field({.time = 0}).bar_end, 10);
    for (int i = 0; i < 100; ++i)
        clock.grow_bar(0);
    EXPECT_TRUE(clock.frame_at(clock.field({.time = 0}).bar_end)) << "every place of the bar is a frame";
}

TEST(Timeline, fills_the_time_bar) {
    Timeline clock(0, 25, Timeline::Source::frames);
    clock.set_loop({.from = 1});
    clock.set_speed(0.5, 0);
    clock.toggle_pause(0);
    const overlay::TimeField field = clock.field({.frame = 7, .time = 3.5});
    EXPECT_EQ(field.seconds, 3.5);
    EXPECT_EQ(field.frame, 7);
    EXPECT_TRUE(field.paused);
    EXPECT_EQ(field.speed, 0.5);
    EXPECT_FALSE(field.has_speed);
    EXPECT_EQ(field.loop_from, 1);
    EXPECT_EQ(field.loop_to, std::nullopt);
    EXPECT_TRUE(Timeline(0).field({}).has_speed);
}

} // namespace tidemark::window::timeline_test
