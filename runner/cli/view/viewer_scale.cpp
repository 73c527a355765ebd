// The size of the drawn picture: the window's pixels times the render scale. Events are converted to pixels
// of the drawn picture.
#include "cli/console.hpp"
#include "cli/view/viewer.hpp"

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
        return say("a recording has its places in pixels: the scale stays");
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
        return say("a recording has its places in pixels: the scale stays");
    if (adaptive_) {
        adaptive_.reset();
        return say(fmt::format("the scale stays at {}", scale_.name()));
    }
    const double fps = settings_.adaptive.value_or(settings_.frames.state.fps);
    adaptive_.emplace(fps);
    say(fmt::format("the scale holds {:g} fps", fps));
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

} // namespace tidemark::cli
