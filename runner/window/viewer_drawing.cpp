// The size of the drawn picture: the window's pixels times the render scale. Events are converted to pixels
// of the drawn picture.

#include "host/console.hpp"
#include "render/gl_textures.hpp"
#include "window/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace tidemark::cli {
namespace {

ControlEvent in_picture(const ControlEvent& event, Extent window, Extent picture) {
    return std::visit(
        [&](auto happened) -> ControlEvent {
            if constexpr (requires { happened.at; }) {
                happened.at.x *= double(picture.width) / std::max(window.width, 1);
                happened.at.y *= double(picture.height) / std::max(window.height, 1);
            }
            return happened;
        },
        event);
}

} // namespace

Extent Viewer::drawn_extent() const {
    return scale_.drawn(screen_->extent());
}

/// Passes an event to the scene and draws a paused picture again if it has changed.
void Viewer::control(const ControlEvent& event) {
    const Extent drawn = drawn_extent();
    const ControlEvent seen = in_picture(event, screen_->extent(), drawn);
    if (!controls_.handle(seen, drawn.height))
        return;
    touched_at_ = now_seconds();
    stale_ = true;
    if (std::holds_alternative<KnobTurned>(event))
        doubt_pace();
    if (recording())
        replay_->note(clock_.next_frame_number(), seen);
}

void Viewer::handle(const platform::FramebufferResized&) {
    if (adaptive_)
        adaptive_->forget();
    fit_drawing();
}

/// Sets the drawn size from window and scale. Returns whether it worked; else the old picture is stretched.
bool Viewer::fit_drawing() {
    if (screen_->extent().pixels() == 0)
        return true; // minimised
    touched_at_ = now_seconds();
    stale_ = true;
    if (!stage_)
        return true;
    if (making_ && drawn_extent() != stage_->renderer().extent())
        drop_frame();
    stale_overlay_ = true; // the last picture, until one of that size is drawn
    const auto resized = stage_->renderer().resize(drawn_extent());
    if (!resized)
        say(to_string(resized.error()));
    return resized.has_value();
}

/// Changes the scale; the mouse stays at the same place of the picture. Returns whether it worked.
bool Viewer::change_scale(render::RenderScale wanted) {
    const Extent before = drawn_extent();
    const render::RenderScale scale_before = std::exchange(scale_, wanted);
    const bool fits = fit_drawing();
    if (fits)
        controls_.stretch(before, drawn_extent());
    else
        scale_ = scale_before;
    return fits;
}

/// Sets the scale and ends adaptive scaling.
void Viewer::set_scale(render::RenderScale wanted) {
    if (replay_)
        return say("the scale cannot change during a replay: mouse positions are recorded in pixels");
    if (adaptive_)
        toggle_adaptive();
    if (wanted == scale_)
        return;
    if (stepping_)
        carry_out(live::GiveUpSeek{});
    change_scale(wanted);
}

void Viewer::toggle_adaptive() {
    if (replay_)
        return say("the scale cannot change during a replay: mouse positions are recorded in pixels");
    if (adaptive_) {
        adaptive_.reset();
        return say(fmt::format("adaptive scale is off: the scale stays at {}", scale_.name()));
    }
    const double fps = settings_.adaptive.value_or(settings_.frames.state.fps);
    adaptive_.emplace(fps);
    say(fmt::format("adaptive scale is on: it aims at {:g} fps", fps));
}

/// Returns the timers for the next frame; null while neither the controls nor adaptive scaling need them. The
/// time of the frame before may change the scale of this one, except while a thread compiles, when it is not
/// reliable.
std::vector<render::PassTimer>* Viewer::time_next_frame() {
    if (!controls_open_ && !adaptive_)
        return nullptr;
    std::vector<render::PassTimer>* timers = costs_.next_frame();
    const auto took = costs_.frame_before();
    if (!adaptive_ || !took || scene_.busy())
        return timers;
    const render::RenderScale wanted = adaptive_->after_frame(scale_, *took);
    if (wanted != scale_ && !change_scale(wanted))
        toggle_adaptive();
    return timers;
}

// Drawing frames: a fast one as a whole, one that may be slow in parts, over several iterations of the event
// loop. Events are handled in between, and the last frame stays on show until the next one is complete.

namespace {

using Way = render::FramePace::Way;

/// Drawing time in one iteration: two of these and a part take less than 0.1 s.
constexpr double k_turn_seconds = 0.03;
/// A frame or a part that takes longer than k_long_seconds counts as long: Esc cancels the frame. A part that
/// takes longer than k_too_long_seconds is reported.
constexpr double k_long_seconds = 1;
constexpr double k_too_long_seconds = 2;
/// Interval at which the progress over the picture is updated.
constexpr double k_clock_seconds = 0.25;
/// Progress is not shown before this time.
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

/// Returns the state of the frame to draw now.
render::FrameState Viewer::next_state(double now) {
    render::FrameState state = clock_.next_frame(now, settings_.frames.state);
    state.date = settings_.date ? *settings_.date : render::later(render::local_date(), -state.seconds());
    state.extent = stage_->renderer().extent();
    if (replay_)
        replay_->fill(state);
    else
        controls_.fill(state);
    controls_.frame_drawn(); // later events belong to the next frame
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

/// Lets what waits for the driver run between two parts, and starts no part before that, because one may
/// never end. Returns whether the next part may start.
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
    if (drawn) { // else nothing is known about the next one's time
        pace_.took(made.state.extent, Way::in_parts, seconds);
        slow_ = now_seconds() - made.begun > k_long_seconds;
    }
    frame_is_drawn(made.state, made.begun, drawn, made.wanted);
}

/// Makes it the frame on show.
void Viewer::frame_is_drawn(const render::FrameState& state, double begun, bool drawn, bool wanted) {
    shown_ = state;
    shown_begun_ = begun;
    has_frame_ = true;
    if (drawn || wanted || stale_overlay_ || screen_->wants_frame())
        present(drawn);
    if (drawn)
        finite_.frame_drawn();
    // Frames must keep counting while they are recorded, or while the scene reads iFrame.
    at_rest_ = !drawn && !stage_->renderer().follows_clock() && !replay_;
    if (at_rest_)
        clock_.rest();
    if (reloaded_)
        report_reload();
    if (std::exchange(save_due_, false))
        save_picture();
}

/// Cancels the frame or the seek in progress; the next frame gets the same number.
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
    say(fmt::format("{}: frame cancelled, {}: press space to continue, - to draw smaller, or save a file of "
                    "it; Esc again closes the window",
                    settings_.scene.path.string(), drawn));
    if (driver_is_held(now))
        say("the driver cannot be stopped: its current work ends by itself");
}

/// Reports a part that takes too long, once for each frame. An endless loop cannot be distinguished from a
/// very long one.
void Viewer::say_what_holds(double now) {
    const auto& at = making_->frame.under_way();
    if (making_->said || !at || now - at->begun < k_too_long_seconds)
        return;
    making_->said = true;
    const Rectangle& area = at->part.area;
    say(fmt::format("{}: {}x{} pixels of {} from {},{} on take more than {:.0f} s: a very long or endless "
                    "loop; Esc cancels the frame, - draws smaller",
                    settings_.scene.path.string(), area.extent.width, area.extent.height,
                    stage_->renderer().scene().passes[at->part.pass].name, area.x, area.y,
                    k_too_long_seconds));
}

/// Discards the estimate of the frame time, as another time or setting may be slower. The first parts of the
/// next frame measure it.
void Viewer::doubt_pace() {
    constexpr size_t k_first_parts = 16;
    pace_.doubt();
    part_size_.doubt(drawn_extent().pixels() / k_first_parts);
}

bool Viewer::draws_for_long(double now) const {
    return making_ && now - making_->begun > k_long_seconds;
}

/// Returns whether drawing the frame on show again as a whole would block the window. The time of the last
/// frame alone does not show that: it may have waited for other work, and without motion it is never updated.
bool Viewer::drawing_would_hold() const {
    return slow_ && pace_.expected(drawn_extent()).value_or(k_long_seconds) >= k_long_seconds;
}

/// Returns the part that the driver is drawing: of this frame, of one that leads to another, or of a
/// cancelled one.
const std::optional<render::FrameInParts::UnderWay>& Viewer::driver_at() const {
    if (stepping_ && stepping_->frame())
        return stepping_->frame()->under_way();
    return making_ ? making_->frame.under_way() : ending_;
}

/// Returns whether the driver is busy for longer than an iteration; any other GL call would wait as long.
bool Viewer::driver_is_at_work() const {
    const auto& at = driver_at();
    return at && !at->end.wait(k_turn_seconds);
}

/// Returns whether the driver has been busy with one part for more than k_long_seconds.
bool Viewer::driver_is_held(double now) const {
    const auto& at = driver_at();
    return at && now - at->begun > k_long_seconds && !at->end.wait(0);
}

/// Returns the progress of a slow frame; empty: there is none.
std::string Viewer::drawing_words(double now) const {
    if (!making_) {
        return driver_is_held(now)
                   ? fmt::format("cancelled, waiting for the driver: {:.0f} s", now - ending_->begun)
                   : "";
    }
    const double seconds = now - making_->begun;
    if (seconds < k_short_seconds && has_frame_)
        return "";
    return fmt::format("drawing {:.1f} s, {:.0f} %{}", seconds, 100 * making_->frame.share(),
                       seconds > k_long_seconds ? ", Esc cancels" : "");
}

// A picture that stays on show while the scene and its time go on.

void Viewer::toggle_freeze() {
    if (!has_frame())
        return;
    stale_overlay_ = true;
    if (std::exchange(frozen_, std::nullopt))
        return;
    auto target = gl::copy_in_bytes(stage_->renderer().target());
    if (!target)
        return say("the driver has no memory to freeze the picture");
    frozen_.emplace(Frozen{*std::move(target), read_picture(), moment()});
}

const gl::RenderTarget* Viewer::target_on_show() const {
    if (frozen_)
        return &frozen_->target;
    return stage_ ? &stage_->renderer().target() : nullptr;
}

} // namespace tidemark::cli
