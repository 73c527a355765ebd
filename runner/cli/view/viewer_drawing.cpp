// Frames: one that is quick is drawn whole, one that may not be in parts, over several turns of the event
// loop. So people are listened to meanwhile, and see the last frame until the next one is whole.
#include "cli/console.hpp"
#include "cli/view/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::cli {
namespace {

using Way = render::FramePace::Way;

/// Of a turn that draws: two of these and a part are within a tenth of a second.
constexpr double k_turn_seconds = 0.03;
/// A frame that is drawn for longer is one that people may want to be rid of, and so is a part.
constexpr double k_long_seconds = 1;
constexpr double k_too_long_seconds = 2;
/// The clock over the picture is no older.
constexpr double k_clock_seconds = 0.25;
/// So long drawing goes unmentioned.
constexpr double k_short_seconds = 0.3;

} // namespace

void Viewer::draw(double now) {
    if (goes_on())
        return carry_on(now);
    const bool due = stale_ || (moving() && now >= next_draw_);
    if (!stage_ || making_ || given_up_ || !due) {
        stale_ = stale_ && making_;
        return present(false);
    }
    const bool wanted = std::exchange(stale_, false);
    next_draw_ = std::max(next_draw_ + 1 / settings_.frames.state.fps, now);
    std::vector<render::PassTimer>* timers = time_next_frame();
    const render::FrameState state = next_state(now);
    if (parts_fail_ || pace_.way(state.extent) == Way::whole)
        draw_whole(state, wanted, now, timers);
    else
        begin_frame(state, wanted, now);
}

/// Of the frame that is drawn now.
render::FrameState Viewer::next_state(double now) {
    render::FrameState state = clock_.next_frame(now);
    state.date = settings_.date ? *settings_.date : render::later(render::local_date(), -state.seconds());
    state.extent = stage_->renderer().extent();
    if (replay_)
        replay_->fill(state);
    else
        controls_.fill(state);
    controls_.frame_drawn(); // what happens from now on is new in the next one
    return state;
}

void Viewer::draw_whole(const render::FrameState& state, bool wanted, double now,
                        std::vector<render::PassTimer>* timers) {
    render::Renderer& renderer = stage_->renderer();
    const size_t before = renderer.passes_drawn();
    renderer.draw(heard_inputs(state), timers);
    drew_ = renderer.passes_drawn() != before;
    frame_is_drawn(state, now, drew_, wanted);
}

void Viewer::begin_frame(const render::FrameState& state, bool wanted, double now) {
    render::FrameInParts frame(stage_->renderer(), heard_inputs(state), part_size_, now_seconds);
    making_.emplace(Making{state, std::move(frame), now, wanted});
    carry_on(now);
}

void Viewer::carry_on(double now) {
    stale_overlay_ |= draws_for_long(now) && now - clock_shown_at_ > k_clock_seconds;
    if (!make_way())
        return say_what_holds(now);
    const size_t before = stage_->renderer().passes_drawn();
    const auto whole = making_->frame.draw_for(k_turn_seconds);
    if (!whole) {
        say(to_string(whole.error()));
        parts_fail_ = stale_ = true;
        return drop_frame();
    }
    if (*whole)
        return frame_is_made(stage_->renderer().passes_drawn() != before);
    say_what_holds(now);
}

/// What waits for the driver has it between two parts, and no part is begun before: one of them may never
/// end. Whether the next may be begun.
bool Viewer::make_way() {
    const bool due = overlay_due();
    if (!due && events_held_.empty())
        return true;
    if (driver_is_at_work())
        return false;
    if (due)
        present(false);
    return events_held_.empty();
}

void Viewer::frame_is_made(bool drawn) {
    const Making made = *std::exchange(making_, std::nullopt);
    double seconds = 0;
    for (const auto& [pass, took] : made.frame.seconds()) {
        seconds += took;
        costs_.took(pass, took * 1000);
    }
    if (drawn) { // else nothing is known of the next one
        pace_.took(made.state.extent, Way::in_parts, seconds);
        slow_ = now_seconds() - made.begun > k_long_seconds;
    }
    frame_is_drawn(made.state, made.begun, drawn, made.wanted);
}

/// It is the one on show from now on.
void Viewer::frame_is_drawn(const render::FrameState& state, double begun, bool drawn, bool wanted) {
    shown_ = state;
    shown_begun_ = begun;
    has_frame_ = true;
    if (drawn || wanted || stale_overlay_ || screen_->wants_frame())
        present(drawn);
    if (drawn)
        finite_.frame_drawn();
    // Frames are counted on where somebody writes their numbers down, or reads them.
    at_rest_ = !drawn && !stage_->renderer().follows_clock() && !replay_;
    if (at_rest_)
        clock_.rest();
    if (reloaded_)
        report_reload();
    if (std::exchange(save_due_, false))
        save_picture();
}

/// What is half drawn, or on its way, is not wanted any more: the next frame has its number.
void Viewer::drop_frame() {
    auto at = stepping_ ? stepping_->give_up()
              : making_ ? render::FrameInParts::give_up(std::move(making_->frame))
                        : std::nullopt;
    if (at)
        ending_ = std::move(at);
    if (std::exchange(making_, std::nullopt))
        clock_.give_frame_back();
    stepping_.reset();
}

void Viewer::give_frames_up(double now) {
    const std::string drawn = making_ ? fmt::format("after {:.1f} s, {:.0f} % drawn", now - making_->begun,
                                                    100 * making_->frame.share())
                                      : fmt::format("a frame takes {:.1f} s", held_seconds_);
    drop_frame();
    forget_what_follows();
    given_up_ = true;
    given_up_at_ = now;
    clock_.rest();
    say(fmt::format("{}: given up, {}: it goes on with space, smaller with -, or when a file of it is saved; "
                    "Esc again closes the window",
                    settings_.scene.path.string(), drawn));
    if (driver_is_held(now))
        say("the driver cannot be stopped: what it is at ends by itself");
}

/// Once a frame. A loop that never ends looks like this, and nobody can tell it from one that does.
void Viewer::say_what_holds(double now) {
    const auto& at = making_->frame.under_way();
    if (making_->said || !at || now - at->begun < k_too_long_seconds)
        return;
    making_->said = true;
    const Rectangle& area = at->part.area;
    say(fmt::format("{}: {}x{} pixels of {} from {},{} on take more than {:.0f} s: a very long loop, or one "
                    "that never ends; Esc gives the frame up, - draws smaller",
                    settings_.scene.path.string(), area.extent.width, area.extent.height,
                    stage_->renderer().scene().passes[at->part.pass].name, area.x, area.y,
                    k_too_long_seconds));
}

/// Another place or another setting may take another time: a part of the frame tells.
void Viewer::doubt_pace() {
    constexpr size_t k_first_parts = 16;
    pace_.doubt();
    part_size_.doubt(drawn_extent().pixels() / k_first_parts);
}

bool Viewer::draws_for_long(double now) const {
    return making_ && now - making_->begun > k_long_seconds;
}

/// Whether the frame on show, drawn once more and whole, would hold the window. That the last one took long
/// does not say so: it may have waited for others, and where nothing moves none follows it.
bool Viewer::drawing_would_hold() const {
    return slow_ && pace_.expected(drawn_extent()).value_or(k_long_seconds) >= k_long_seconds;
}

/// What the driver is drawing, for this frame, for one that leads to another, or for one that was given up.
const std::optional<render::FrameInParts::UnderWay>& Viewer::driver_at() const {
    if (stepping_ && stepping_->frame())
        return stepping_->frame()->under_way();
    return making_ ? making_->frame.under_way() : ending_;
}

/// With what will not be done at once. Whoever asks it for anything else waits for as long.
bool Viewer::driver_is_at_work() const {
    const auto& at = driver_at();
    return at && !at->end.wait(k_turn_seconds);
}

/// At work for so long that people want to know.
bool Viewer::driver_is_held(double now) const {
    const auto& at = driver_at();
    return at && now - at->begun > k_long_seconds && !at->end.wait(0);
}

/// The clock of a frame that takes long; empty: none does.
std::string Viewer::drawing_words(double now) const {
    if (!making_) {
        return driver_is_held(now)
                   ? fmt::format("given up, the driver ends it: {:.0f} s", now - ending_->begun)
                   : "";
    }
    const double seconds = now - making_->begun;
    if (seconds < k_short_seconds && has_frame_)
        return "";
    return fmt::format("drawing {:.1f} s, {:.0f} %{}", seconds, 100 * making_->frame.share(),
                       seconds > k_long_seconds ? ", Esc gives up" : "");
}

} // namespace tidemark::cli
