// Lenses of the window without a window: which one is chosen, what is drawn next, what the panels show.
#include "support/scene_of.hpp"
#include "window/lens_view.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

namespace tidemark::window::lens_view_test {

using Kind = LensOrder::Kind;
using Mark = lab::LensNumbers::Mark;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr Extent k_extent{4, 2};

std::shared_ptr<const scene::Scene> some_scene() {
    return std::make_shared<const scene::Scene>(scene_of("#iUniform float height = 1.0 in { 0.0, 9.0 }\n"));
}

LensMoment moment_of(const LensView& view, int frame, double height = 1) {
    LensMoment moment{view.scene(), {}, {}};
    moment.state.frame = frame;
    moment.state.extent = moment.quick = k_extent;
    moment.state.knobs = {{"height", {1, {height}}}};
    return moment;
}

/// A picture of 4x2 pixels: 1 to 8, the last one marked, the first one absent.
LensPicture picture_of(const lab::Lens& lens) {
    LensPicture picture;
    picture.plan.lens = lens;
    picture.plan.title = "iterations of a march";
    picture.plan.unit = "iterations";
    picture.plan.marked = "run out";
    picture.plan.absent = "no march";
    picture.numbers = {.extent = k_extent, .values = {1, 2, 3, 4, 5, 6, 7, 8}};
    picture.numbers.marks.assign(8, Mark::number);
    picture.numbers.marks.front() = Mark::absent;
    picture.numbers.marks.back() = Mark::marked;
    picture.summary = lab::summary_of(picture.plan, picture.numbers);
    picture.range = lab::range_of(picture.plan, picture.summary);
    return picture;
}

LensView with_scene() {
    LensView view;
    view.set_scene(some_scene());
    return view;
}

std::string kind_of(const std::optional<LensOrder>& order) {
    if (!order)
        return "nothing";
    return order->kind == Kind::numbers ? lab::to_string(order->lens)
           : order->kind == Kind::facts ? "facts"
                                        : "lines";
}

/// Carries out the next order, as a thread would, with a result.
template <class T>
std::string answer(LensView& view, const LensMoment& moment, T result, double now = 0) {
    const auto order = view.next(moment, false, now);
    if (order)
        view.take({*order, std::move(result)}, now);
    return kind_of(order);
}

TEST(LensView, steps_through_the_lenses_that_need_no_line) {
    LensView view = with_scene();
    std::vector<std::string> seen;
    for (int i = 0; i < 7; ++i) {
        view.step(1);
        seen.push_back(view.chosen());
    }
    EXPECT_THAT(seen, ElementsAre("cost", "steps", "error", "rounding", "proof", "clocks", ""));
    view.step(-1);
    EXPECT_EQ(view.chosen(), "clocks");
    EXPECT_THAT(view.take_message(), HasSubstr("lens clocks: cycles of the device's clock"));
}

TEST(LensView, a_lens_with_a_line_comes_last) {
    LensView view = with_scene();
    view.choose("value:12:d");
    EXPECT_EQ(view.chosen(), "value:12:d");
    EXPECT_EQ(view.chooser().place, "12");
    EXPECT_EQ(view.chooser().variable, "d");
    ASSERT_TRUE(view.chooser().chosen);
    EXPECT_EQ(view.chooser().choices[*view.chooser().chosen].name, "value");
    view.step(1);
    EXPECT_FALSE(view.on());
    view.choose("branch:3:2");
    view.step(-1);
    EXPECT_EQ(view.chosen(), "clocks");
    EXPECT_EQ(view.chooser().variable, "2");
}

TEST(LensView, a_late_refusal_leaves_the_next_lens_unchanged) {
    LensView view = with_scene();
    view.choose("steps");
    const auto order = view.next(moment_of(view, 0), false, 0);
    ASSERT_TRUE(order);
    view.choose("error");
    view.take({*order, Error{ErrorCode::load, "no marching loop"}}, 0);
    EXPECT_EQ(view.chosen(), "error");
    EXPECT_THAT(view.take_message(), HasSubstr("lens error: float against double"));
    EXPECT_EQ(kind_of(view.next(moment_of(view, 0), false, 0)), "error");
    EXPECT_EQ(view.chooser().choices[1].refusal, "no marching loop");
}

TEST(LensView, a_step_goes_past_what_the_scene_refuses) {
    LensView view = with_scene();
    view.choose("cost");
    view.step(1);
    answer(view, moment_of(view, 0), Error{ErrorCode::load, "no marching loop"});
    EXPECT_EQ(view.chosen(), "error");
    EXPECT_EQ(view.chooser().choices[1].refusal, "no marching loop");
    view.step(-1); // its refusal is known
    EXPECT_EQ(view.chosen(), "cost");
    view.set_scene(some_scene());
    view.step(1);
    EXPECT_EQ(view.chosen(), "steps");
}

TEST(LensView, a_lens_from_the_list_stays_and_says_why_it_is_refused) {
    LensView view = with_scene();
    view.choose("steps");
    answer(view, moment_of(view, 0), Error{ErrorCode::load, "no marching loop"});
    EXPECT_EQ(view.chosen(), "steps");
    ASSERT_TRUE(view.field({}));
    EXPECT_EQ(view.field({})->refusal, "no marching loop");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 1), false, 0)), "nothing");
    view.choose("value");
    EXPECT_THAT(view.field({})->refusal, HasSubstr("give a line from 1"));
    EXPECT_EQ(kind_of(view.next(moment_of(view, 1), false, 0)), "nothing");
    view.choose("steps");
    view.set_scene(some_scene()); // a reload may have a march
    EXPECT_EQ(view.field({})->refusal, "");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 1), false, 0)), "steps");
}

TEST(LensView, a_scene_that_can_have_no_lens) {
    LensView view;
    view.set_scene(some_scene(), "only Image has a lens");
    view.step(1);
    EXPECT_EQ(view.field({})->refusal, "only Image has a lens");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 0), false, 0)), "nothing");
}

TEST(LensView, each_moment_is_drawn_once) {
    LensView view = with_scene();
    EXPECT_EQ(kind_of(view.next(moment_of(view, 0), true, 0)), "nothing");
    view.choose("steps");
    EXPECT_EQ(answer(view, moment_of(view, 0), picture_of({})), "steps");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 0), false, 0)), "nothing");
    EXPECT_EQ(answer(view, moment_of(view, 1), picture_of({})), "steps");
    view.choose("error");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 1), false, 0)), "error");
    view.choose("");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 2), false, 0)), "nothing");
    EXPECT_FALSE(view.field({}));
}

TEST(LensView, each_result_arrives_in_turn) {
    LensView view = with_scene();
    view.choose("steps");
    view.toggle_status();
    view.watch_lines(true);
    std::string order;
    for (int frame = 0; frame < 6; ++frame) {
        const auto next = view.next(moment_of(view, frame), true, 10.0 * frame);
        order += kind_of(next) + " ";
        if (next && next->kind == Kind::numbers)
            view.take({*next, picture_of({})}, 10.0 * frame);
        else if (next && next->kind == Kind::facts)
            view.take({*next, FrameFacts{}}, 10.0 * frame);
        else if (next)
            view.take({*next, lab::HotLines{}}, 10.0 * frame);
    }
    EXPECT_EQ(order, "steps facts lines steps facts lines ");
}

TEST(LensView, a_lens_that_was_just_chosen_comes_first) {
    LensView view = with_scene();
    view.toggle_status();
    const auto facts = view.next(moment_of(view, 0), false, 0);
    ASSERT_EQ(kind_of(facts), "facts");
    EXPECT_FALSE(view.is_stale(*facts, moment_of(view, 0)));
    view.choose("steps");
    EXPECT_TRUE(view.is_stale(*facts, moment_of(view, 0)));
    EXPECT_EQ(answer(view, moment_of(view, 0), picture_of({})), "steps");
    EXPECT_FALSE(view.is_stale(*facts, moment_of(view, 0)));
    EXPECT_EQ(answer(view, moment_of(view, 0), FrameFacts{}), "facts");
}

TEST(LensView, facts_wait_while_time_runs) {
    LensView view = with_scene();
    view.toggle_status();
    EXPECT_EQ(answer(view, moment_of(view, 0), FrameFacts{}, 5), "facts");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 1), true, 5.5)), "nothing");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 1), false, 5.5)), "facts");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 1), true, 6.5)), "facts");
}

TEST(LensView, feedback_needs_the_buffers_of_that_frame) {
    LensView view = with_scene();
    view.choose("steps");
    LensMoment moment = moment_of(view, 3);
    moment.has_feedback = true;
    EXPECT_TRUE(view.wants_buffers());
    EXPECT_EQ(kind_of(view.next(moment, true, 0)), "nothing");
    view.keep_buffers(moment.state, {});
    EXPECT_FALSE(view.buffers_for(moment_of(view, 4).state));
    moment.buffers = view.buffers_for(moment.state);
    EXPECT_EQ(kind_of(view.next(moment, true, 0)), "steps");
}

TEST(LensView, a_proof_is_refined_until_the_moment_changes) {
    LensView view = with_scene();
    view.choose("proof");
    const auto order = view.next(moment_of(view, 0), false, 0);
    ASSERT_EQ(kind_of(order), "proof");
    EXPECT_FALSE(view.is_stale(*order, moment_of(view, 1))); // nothing is known yet
    LensPicture coarse = picture_of({.name = lab::LensName::proof});
    coarse.numbers.complete = false;
    view.take({*order, coarse}, 0);
    EXPECT_FALSE(view.is_stale(*order, moment_of(view, 0)));
    EXPECT_TRUE(view.is_stale(*order, moment_of(view, 1)));
    EXPECT_EQ(view.field({})->progress, "87.5 % known");
    view.choose("cost");
    EXPECT_TRUE(view.is_stale(*order, moment_of(view, 0)));
}

TEST(LensView, the_legend_names_the_number_under_the_pointer) {
    LensView view = with_scene();
    view.choose("steps");
    EXPECT_EQ(view.field({})->progress, "drawing");
    answer(view, moment_of(view, 0), picture_of({}));
    const auto field = view.field(std::array{2, 0});
    EXPECT_EQ(field->title, "iterations of a march");
    EXPECT_EQ(field->basis, "steps: iterations, counted");
    EXPECT_EQ(field->pointer, "2,0: 3 iterations");
    EXPECT_EQ(field->low, "0");
    EXPECT_EQ(field->high, "10");
    ASSERT_TRUE(field->mark);
    EXPECT_DOUBLE_EQ(*field->mark, 0.3);
    EXPECT_EQ(field->bar.front(), lab::lens_colour(0));
    EXPECT_EQ(field->bar.back(), lab::lens_colour(1));
    std::string entries;
    for (const overlay::LegendField& entry : field->entries)
        entries += entry.words + "; ";
    EXPECT_EQ(entries, "min 2; median 5; 99 % below 7.94; max 8; run out 12.5 %; no march 12.5 %; ");
    EXPECT_EQ(view.field(std::array{0, 0})->pointer, "0,0: no march");
    EXPECT_EQ(view.field(std::array{3, 1})->pointer, "3,1: 8 iterations, run out");
    EXPECT_FALSE(view.field(std::array{3, 1})->mark);
    EXPECT_EQ(view.field({})->pointer, "");
}

TEST(LensView, a_front_has_the_last_five_values) {
    LensView view = with_scene();
    view.turn_knob("height");
    for (int value = 2; value < 9; ++value) {
        FrameFacts facts;
        facts.milliseconds = value;
        facts.error = 0.5 * value;
        EXPECT_EQ(answer(view, moment_of(view, 0, value), facts), "facts");
        EXPECT_EQ(kind_of(view.next(moment_of(view, 1, value), true, 9)), "nothing"); // the value is known
    }
    ASSERT_TRUE(view.front());
    std::string points;
    for (const overlay::FrontField::Point& point : view.front()->points)
        points += fmt::format("{} {} {}; ", point.value, point.milliseconds, point.error);
    EXPECT_EQ(points, "4 4 2; 5 5 2.5; 6 6 3; 7 7 3.5; 8 8 4; ");
    view.turn_knob("height");
    EXPECT_EQ(view.front()->points.size(), 5U);
    view.turn_knob("depth");
    EXPECT_TRUE(view.front()->points.empty());
}

TEST(LensView, the_status_line_has_error_rays_and_nan) {
    LensView view = with_scene();
    view.toggle_status();
    EXPECT_EQ(view.status(2.5), "2.5 ms a frame  comparing with double");
    FrameFacts facts;
    facts.error = 0.0125;
    facts.worst = 3;
    facts.worst_at = {7, 9};
    facts.run_out = 12;
    facts.nan = 1;
    answer(view, moment_of(view, 0), facts);
    EXPECT_EQ(view.status(2.5), "2.5 ms a frame  error against double: RMSE 0.0125/255, worst 3/255 at 7,9  "
                                "rays out of steps: 12  NaN: 1");
    facts.error.reset();
    facts.run_out.reset();
    facts.no_error = "no double";
    answer(view, moment_of(view, 1), facts);
    EXPECT_EQ(view.status({}), "no error against double: no double  NaN: 1");
}

TEST(LensView, hot_lines_come_with_the_frame_that_was_counted) {
    LensView view = with_scene();
    view.watch_lines(true);
    EXPECT_EQ(answer(view, moment_of(view, 7), lab::HotLines{375, {{{"a.glsl", 3, 0}, "x += y;", 0.75}}}),
              "lines");
    ASSERT_EQ(view.hot_lines().lines.size(), 1U);
    EXPECT_EQ(view.hot_lines().lines[0].where.line, 3);
    EXPECT_EQ(view.hot_lines().lines[0].share, 0.75);
    EXPECT_EQ(view.hot_lines().note, "375 weighted operations per pixel, frame 7 in 4x2");
    EXPECT_EQ(kind_of(view.next(moment_of(view, 7), false, 0)), "nothing");
    LensMoment later = moment_of(view, 500);
    later.has_feedback = true;
    EXPECT_EQ(counted_state(later).frame, 30);
}

} // namespace tidemark::window::lens_view_test
