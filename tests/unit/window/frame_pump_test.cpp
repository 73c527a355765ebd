// When frames are drawn, whole or in parts, with a fake maker of frames and a fake clock.
#include "window/frame_pump.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace tidemark::window::frame_pump_test {

using testing::ElementsAre;
using Flow = FramePump::Flow;
using Around = FramePump::Around;

constexpr Extent k_extent{100, 100};
constexpr double k_never = std::numeric_limits<double>::infinity();

/// A driver whose work takes time by a clock that the tests set.
struct FakeDriver {
    double now = 100;
    double frame_seconds = 0.001; ///< of a whole frame
    double hangs_until = 0;       ///< a part does not end before
    bool parts_fail = false;
    bool has_pass = true;      ///< frames have something to draw
    std::vector<int> frames{}; ///< the complete ones, -1 for a reset
    int half_drawn = 0;        ///< frames in parts that exist
};

class FakeParts : public FrameParts {
public:
    FakeParts(FakeDriver& driver, int frame) : driver_(driver), frame_(frame) { ++driver.half_drawn; }
    ~FakeParts() override { --driver_.half_drawn; }

    Result<bool> draw_for(double seconds) override {
        if (driver_.parts_fail)
            return fail(ErrorCode::load, "no memory for parts");
        begun_ = driver_.now;
        const double time = std::min(seconds, driver_.frame_seconds - drawn_);
        driver_.now += time;
        drawn_ += time;
        seconds_ = {{0, drawn_}};
        if (drawn_ < driver_.frame_seconds - 1e-9)
            return false;
        driver_.frames.push_back(frame_);
        return true;
    }
    bool drew_pass() const override { return driver_.has_pass; }
    double share() const override { return drawn_ / driver_.frame_seconds; }
    const std::vector<render::FrameInParts::PassSeconds>& seconds() const override { return seconds_; }
    std::optional<DriverWork> work() const override {
        return DriverWork{{0, 0, {0, 0, {10, 4}}}, begun_, [&driver = driver_](double wait) {
                              return driver.now + wait >= driver.hangs_until;
                          }};
    }
    std::optional<DriverWork> cancel() override { return work(); }

private:
    FakeDriver& driver_;
    int frame_;
    double begun_ = 0;
    double drawn_ = 0;
    std::vector<render::FrameInParts::PassSeconds> seconds_;
};

class FakeMaker : public FrameMaker {
public:
    explicit FakeMaker(FakeDriver& driver) : driver_(driver) {}

    Extent extent() const override { return k_extent; }
    bool draw(const render::FrameInputs& inputs, std::vector<render::PassTimer>*) override {
        driver_.now += driver_.frame_seconds;
        driver_.frames.push_back(inputs.frame);
        return driver_.has_pass;
    }
    std::unique_ptr<FrameParts> begin(const render::FrameInputs& inputs, render::PartSize&) override {
        return std::make_unique<FakeParts>(driver_, inputs.frame);
    }
    void finish() override {}
    void reset() override { driver_.frames.push_back(-1); }

private:
    FakeDriver& driver_;
};

render::FrameState state_of(int frame) {
    return {.frame = frame, .extent = k_extent};
}

class FramePumpTest : public testing::Test {
protected:
    /// Begins the next frame if it is due; returns it if it is complete.
    std::optional<FramePump::Made> begin(int frame) {
        pump.begin_round(k_extent);
        pump.begin_waiting();
        pump.end_round();
        const auto wanted = pump.take_due(around, driver.now);
        EXPECT_TRUE(wanted) << "no frame is due";
        return pump.begin(maker, state_of(frame), inputs_of(state_of(frame)), wanted.value_or(false),
                          driver.now);
    }
    std::optional<FramePump::Made> advance() {
        auto made = pump.advance();
        EXPECT_TRUE(made);
        return made ? *std::move(made) : std::nullopt;
    }
    /// Draws the first frames, so that their time is known.
    void warm_up(double seconds) {
        driver.frame_seconds = seconds;
        ASSERT_FALSE(begin(0));
        while (!advance()) {
        }
    }
    bool due() const { return pump.due(around, driver.now) <= driver.now; }

    FakeDriver driver;
    FakeMaker maker{driver};
    FramePump pump{50, [this] { return driver.now; }};
    Around around;
};

TEST_F(FramePumpTest, draws_the_first_frame_in_parts_and_fast_frames_whole) {
    EXPECT_FALSE(begin(0));
    EXPECT_TRUE(pump.drawing());
    const auto first = advance();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->state.frame, 0);
    EXPECT_TRUE(first->wanted) << "a window shows a picture at once";
    EXPECT_EQ(first->seconds.size(), 1U);
    EXPECT_FALSE(pump.drawing());
    driver.now += 0.02;
    const auto second = begin(1);
    ASSERT_TRUE(second) << "drawn whole";
    EXPECT_FALSE(second->wanted);
    EXPECT_THAT(driver.frames, ElementsAre(0, 1));
}

TEST_F(FramePumpTest, keeps_the_frame_rate) {
    warm_up(0.001);
    ASSERT_TRUE(begin(1)) << "at once";
    EXPECT_NEAR(pump.due(around, driver.now), driver.now + 0.02, 0.0021);
    EXPECT_FALSE(pump.wants_frame(around, driver.now));
    EXPECT_FALSE(pump.take_due(around, driver.now));
    driver.now += 0.02;
    EXPECT_TRUE(pump.wants_frame(around, driver.now));
    EXPECT_TRUE(begin(2));
    EXPECT_FALSE(pump.take_due(around, driver.now)) << "one frame in 20 ms";
}

TEST_F(FramePumpTest, a_change_by_the_user_is_drawn_at_once) {
    warm_up(0.001);
    pump.ask();
    EXPECT_TRUE(due());
    const auto made = begin(1);
    ASSERT_TRUE(made);
    EXPECT_TRUE(made->wanted);
}

TEST_F(FramePumpTest, a_slow_frame_takes_several_rounds) {
    driver.frame_seconds = 0.1;
    EXPECT_FALSE(begin(0));
    for (int round = 0; round < 3; ++round) {
        EXPECT_TRUE(pump.goes_on(around, driver.now));
        EXPECT_TRUE(due());
        EXPECT_FALSE(advance());
    }
    EXPECT_THAT(driver.frames, ElementsAre());
    const auto made = advance();
    ASSERT_TRUE(made);
    EXPECT_TRUE(made->drawn);
    EXPECT_NEAR(*pump.expected(k_extent), 0.1, 1e-9);
    EXPECT_FALSE(pump.would_block(k_extent)) << "0.1 s";
}

TEST_F(FramePumpTest, no_frame_is_due_while_paused_still_or_unwatched) {
    warm_up(0.001);
    driver.now += 1;
    around.plays = false;
    EXPECT_EQ(pump.due(around, driver.now), k_never);
    EXPECT_FALSE(pump.moving(around));
    around.plays = true;
    pump.set_still(true);
    EXPECT_EQ(pump.flow(), Flow::still);
    EXPECT_EQ(pump.due(around, driver.now), k_never);
    pump.ask();
    EXPECT_TRUE(pump.wants_frame(around, driver.now)) << "until there is input";
    around.watched = false;
    EXPECT_FALSE(pump.wants_frame(around, driver.now));
    EXPECT_EQ(pump.due(around, driver.now), k_never);
}

TEST_F(FramePumpTest, panels_are_drawn_without_a_frame_if_none_is_due_soon) {
    warm_up(0.001);
    around.panels_changed = true;
    EXPECT_FALSE(pump.shows_panels(around)) << "the next frame shows them";
    around.plays = false;
    EXPECT_TRUE(pump.shows_panels(around));
    EXPECT_TRUE(pump.wants_frame(around, driver.now));
    EXPECT_FALSE(pump.take_due(around, driver.now));
}

TEST_F(FramePumpTest, a_cancelled_frame_returns_its_number) {
    driver.frame_seconds = 5;
    EXPECT_FALSE(begin(0));
    EXPECT_FALSE(advance());
    driver.hangs_until = driver.now + 3;
    EXPECT_TRUE(pump.driver_busy());
    EXPECT_TRUE(pump.cancel()) << "it was a frame";
    EXPECT_EQ(driver.half_drawn, 0);
    EXPECT_TRUE(pump.ending());
    pump.ask();
    EXPECT_FALSE(pump.wants_frame(around, driver.now)) << "the driver is busy";
    driver.now += 2;
    EXPECT_TRUE(pump.driver_held(driver.now));
    EXPECT_THAT(pump.progress(driver.now, true),
                testing::StartsWith("cancelled, waiting for the driver: 2 s"));
    driver.now += 2;
    pump.begin_round(k_extent);
    EXPECT_FALSE(pump.ending());
    EXPECT_FALSE(pump.cancel()) << "there is nothing any more";
}

/// Nothing else wakes the window then, and a held key would wait for the next event.
TEST_F(FramePumpTest, a_held_event_is_due_as_soon_as_the_driver_is_free) {
    driver.frame_seconds = 5;
    EXPECT_FALSE(begin(0));
    EXPECT_FALSE(advance());
    driver.hangs_until = driver.now + 3;
    pump.cancel();
    pump.stop(driver.now);
    around.events_held = true;
    driver.now += 2;
    EXPECT_TRUE(pump.driver_held(driver.now));
    EXPECT_TRUE(due()) << "each round asks the driver again";
    driver.now += 2;
    pump.begin_round(k_extent);
    EXPECT_FALSE(pump.ending());
    EXPECT_TRUE(due());
    around.events_held = false;
    EXPECT_EQ(pump.due(around, driver.now), k_never);
}

TEST_F(FramePumpTest, stopped_frames_are_restarted_on_request) {
    driver.frame_seconds = 5;
    EXPECT_FALSE(begin(0));
    EXPECT_FALSE(pump.can_stop(around, driver.now)) << "it may still be a quick one";
    while (!pump.draws_for_long(driver.now))
        EXPECT_FALSE(advance());
    EXPECT_TRUE(pump.can_stop(around, driver.now));
    EXPECT_EQ(pump.share_text(driver.now), "after 1.0 s, 20 % drawn");
    pump.cancel();
    pump.stop(driver.now);
    EXPECT_EQ(pump.flow(), Flow::cancelled);
    EXPECT_TRUE(pump.just_stopped(driver.now + 0.5));
    EXPECT_FALSE(pump.just_stopped(driver.now + 1.5));
    pump.ask();
    EXPECT_FALSE(pump.take_due(around, driver.now + 1));
    EXPECT_TRUE(pump.resume());
    EXPECT_FALSE(pump.resume()) << "they run already";
    pump.ask();
    EXPECT_TRUE(pump.take_due(around, driver.now + 1));
}

TEST_F(FramePumpTest, draws_whole_without_memory_for_parts) {
    driver.parts_fail = true;
    EXPECT_FALSE(begin(0));
    EXPECT_FALSE(pump.advance());
    EXPECT_TRUE(pump.cancel());
    ASSERT_TRUE(begin(0));
    EXPECT_THAT(driver.frames, ElementsAre(0));
    driver.now += 0.5;
    pump.forget_scene();
    EXPECT_FALSE(begin(1)) << "another scene may have memory";
}

TEST_F(FramePumpTest, a_blocking_frame_is_detected_afterwards) {
    warm_up(0.001);
    driver.now += 0.02;
    driver.frame_seconds = 3;
    ASSERT_TRUE(begin(1));
    EXPECT_TRUE(pump.begin_round(k_extent)) << "events have waited";
    EXPECT_TRUE(pump.can_stop(around, driver.now));
    EXPECT_EQ(pump.share_text(driver.now), "a frame takes 3.0 s");
    EXPECT_TRUE(pump.would_block(k_extent));
    EXPECT_FALSE(pump.wants_frame(around, driver.now)) << "a breath for events";
    pump.begin_waiting();
    pump.end_round();
    driver.now += 0.06;
    EXPECT_FALSE(begin(2)) << "from now on in parts";
}

TEST_F(FramePumpTest, a_slow_frame_waits_for_a_reload) {
    driver.frame_seconds = 5;
    EXPECT_FALSE(begin(0));
    while (!pump.draws_for_long(driver.now))
        EXPECT_FALSE(advance());
    around.compiles = true;
    EXPECT_FALSE(pump.goes_on(around, driver.now));
    EXPECT_FALSE(pump.wants_frame(around, driver.now));
    around.compiles = false;
    EXPECT_TRUE(pump.wants_frame(around, driver.now));
}

TEST_F(FramePumpTest, reports_the_progress_of_a_slow_frame) {
    driver.frame_seconds = 5;
    EXPECT_EQ(pump.progress(driver.now, true), "");
    EXPECT_FALSE(begin(0));
    EXPECT_FALSE(advance());
    EXPECT_EQ(pump.progress(driver.now, true), "") << "it may be quick";
    EXPECT_EQ(pump.progress(driver.now, false), "drawing 0.0 s, 1 %") << "there is nothing else on show";
    while (!pump.draws_for_long(driver.now))
        EXPECT_FALSE(advance());
    EXPECT_EQ(pump.progress(driver.now, true), "drawing 1.0 s, 20 %, Esc cancels");
    EXPECT_TRUE(pump.progress_due(driver.now));
    pump.progress_shown(driver.now);
    EXPECT_FALSE(pump.progress_due(driver.now));
}

TEST_F(FramePumpTest, slow_frames_show_their_progress_from_the_beginning) {
    const auto draw = [&](double seconds) {
        driver.frame_seconds = seconds;
        if (!begin(0))
            while (!advance())
                ;
    };
    draw(0.4);
    EXPECT_TRUE(pump.frames_show_progress());
    driver.frame_seconds = 0.4;
    EXPECT_FALSE(begin(1));
    EXPECT_FALSE(advance());
    EXPECT_THAT(pump.progress(driver.now, true), testing::StartsWith("drawing 0.0 s, "));
    while (!advance())
        ;
    draw(0.2);
    EXPECT_TRUE(pump.frames_show_progress()) << "a little quicker: the words stay";
    draw(0.1);
    EXPECT_FALSE(pump.frames_show_progress());
}

TEST_F(FramePumpTest, reports_a_part_that_takes_too_long_once) {
    driver.frame_seconds = 5;
    EXPECT_FALSE(begin(0));
    EXPECT_FALSE(advance());
    EXPECT_FALSE(pump.take_slow_part(driver.now + 1));
    const auto part = pump.take_slow_part(driver.now + 3);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->area.extent, (Extent{10, 4}));
    EXPECT_FALSE(pump.take_slow_part(driver.now + 9));
}

TEST_F(FramePumpTest, an_unchanged_frame_gives_no_estimate) {
    driver.has_pass = false;
    EXPECT_FALSE(begin(0));
    const auto made = advance();
    ASSERT_TRUE(made);
    EXPECT_FALSE(made->drawn);
    EXPECT_EQ(pump.expected(k_extent), std::nullopt);
}

TEST_F(FramePumpTest, a_seek_draws_all_frames_a_few_at_a_time) {
    warm_up(0.02);
    driver.frames.clear();
    pump.seek(maker, state_of, 4, 0.1);
    EXPECT_TRUE(pump.seeking());
    EXPECT_FALSE(pump.wants_frame(around, driver.now)) << "no other frame meanwhile";
    EXPECT_EQ(pump.advance_seek(0.03), std::nullopt);
    EXPECT_THAT(driver.frames, ElementsAre(-1, 0, 1));
    EXPECT_EQ(pump.seek_progress().frame, 1);
    EXPECT_EQ(pump.seek_progress().last, 4);
    EXPECT_EQ(pump.seek_next(), 2);
    EXPECT_EQ(pump.advance_seek(0.03), std::nullopt);
    EXPECT_EQ(pump.advance_seek(0.03), 0.1);
    EXPECT_FALSE(pump.seeking());
    EXPECT_THAT(driver.frames, ElementsAre(-1, 0, 1, 2, 3, 4));
}

TEST_F(FramePumpTest, a_seek_draws_slow_frames_in_parts) {
    driver.frame_seconds = 0.1;
    pump.seek(maker, state_of, 1, 2);
    EXPECT_EQ(pump.advance_seek(0.03), std::nullopt);
    EXPECT_EQ(driver.half_drawn, 1);
    EXPECT_EQ(pump.seek_next(), 0) << "a half-drawn frame does not count";
    EXPECT_FALSE(pump.cancel()) << "it was no frame of the window";
    EXPECT_EQ(driver.half_drawn, 0);
    EXPECT_FALSE(pump.seeking());
    driver.frames.clear();
    pump.seek(maker, state_of, 1, 2);
    for (int round = 0; round < 7; ++round)
        pump.advance_seek(0.03);
    EXPECT_FALSE(pump.seeking());
    EXPECT_THAT(driver.frames, ElementsAre(-1, 0, 1));
}

TEST_F(FramePumpTest, a_seek_draws_whole_where_parts_fail) {
    driver.parts_fail = true;
    pump.seek(maker, state_of, 0, 2);
    EXPECT_EQ(pump.advance_seek(0.03), 2);
    EXPECT_THAT(driver.frames, ElementsAre(-1, 0));
}

} // namespace tidemark::window::frame_pump_test
