#include "window/seek.hpp"

#include "window/screen.hpp"
#include "window/viewer.hpp"

#include <algorithm>
#include <utility>

namespace tidemark::cli {

using render::FrameInParts;
using Way = render::FramePace::Way;

SteppingThere::SteppingThere(render::Renderer& renderer, render::FramePace& pace, render::PartSize& size,
                             render::FrameStates states, int frame, double seconds)
    : renderer_(renderer), pace_(pace), size_(size), stepper_(renderer, std::move(states)),
      seconds_(seconds), where_{0, frame} {
    stepper_.draw_by([this](const render::FrameInputs& inputs) { return draw(inputs); });
}

bool SteppingThere::advance(double seconds) {
    until_ = now_seconds() + seconds;
    bool first = true;
    const auto may_draw = [&](int frame, int) {
        if (!std::exchange(first, false) && now_seconds() >= until_)
            return false;
        where_.frame = frame;
        return true;
    };
    return stepper_.draw(where_.last, may_draw).complete;
}

bool SteppingThere::draw(const render::FrameInputs& inputs) {
    const Extent extent = renderer_.extent();
    if (!frame_ && pace_.way(extent) == Way::whole) {
        draw_whole(inputs);
        return true;
    }
    if (!frame_)
        frame_.emplace(renderer_, inputs, size_, now_seconds);
    const auto whole = frame_->draw_for(std::max(0.0, until_ - now_seconds()));
    if (whole && !*whole)
        return false;
    double took = 0;
    for (const FrameInParts::PassSeconds& pass : frame_->seconds())
        took += pass.seconds;
    frame_.reset();
    if (whole)
        pace_.took(extent, Way::in_parts, took);
    else // not enough memory for parts
        draw_whole(inputs);
    return true;
}

void SteppingThere::draw_whole(const render::FrameInputs& inputs) {
    const double begun = now_seconds();
    renderer_.draw(inputs);
    glFinish(); // else some drivers queue much more work than there is time for
    pace_.took(renderer_.extent(), Way::whole, now_seconds() - begun);
}

std::optional<FrameInParts::UnderWay> SteppingThere::give_up() {
    return frame_ ? FrameInParts::give_up(std::move(*frame_)) : std::nullopt;
}

// Time in the window: seeking, speed and loops.

live::TimeField Viewer::time_field() const {
    live::TimeField time{.seconds = shown_.seconds(),
                         .frame = shown_.frame,
                         .paused = clock_.paused(),
                         .speed = clock_.speed(),
                         .turns_back = !has_feedback(),
                         .has_speed = !clock_.by_frames(),
                         .loop_from = loop_.from,
                         .loop_to = loop_.to};
    if (stepping_)
        time.stepping = stepping_->where();
    return time;
}

/// Goes to a time. With feedback all earlier frames are drawn, so that the buffers have their usual contents.
void Viewer::seek(double seconds, double now) {
    const double fps = settings_.frames.state.fps;
    if (!(seconds >= 0 && seconds <= render::k_last_frame / fps))
        return; // a typed number may be out of range
    const int frame = render::frame_at(seconds, fps);
    stale_ = true;
    given_up_ = false;
    if (has_feedback())
        drop_frame(); // without feedback it is completed, so that something is visible while dragging
    clock_.seek(seconds, frame, now);
    doubt_pace();
    forget_what_follows();
    if (!has_feedback())
        return;
    has_frame_ = false;
    if (frame == 0)
        return stage_->renderer().reset();
    render::FrameState state = shown_;
    state.extent = stage_->renderer().extent();
    state.time.reset();
    state.time_delta.reset();
    state.fps = fps;
    const auto states = [state, replay = replay_](int number) mutable {
        render::FrameState seen = state.at_frame(number);
        if (replay)
            replay->fill(seen);
        return seen;
    };
    stepping_ =
        std::make_unique<SteppingThere>(stage_->renderer(), pace_, part_size_, states, frame - 1, seconds);
}

/// Draws a few more frames of a seek, then the bar. At the end, time continues from there.
void Viewer::step_there() {
    constexpr double k_seconds = 1 / 30.0;
    if (!stepping_ || !make_way())
        return;
    if (stepping_->advance(k_seconds)) {
        clock_.seek(stepping_->seconds(), clock_.next_frame_number(), now_seconds());
        stepping_.reset();
    }
    stale_ = !stepping_;
    stale_overlay_ = true;
}

/// Leaves a pause of more than a second without a viewer out of iTimeDelta.
void Viewer::rest_unwatched(double now) {
    constexpr double k_unwatched_seconds = 1;
    if (!screen_->is_watched()) {
        unwatched_since_ = unwatched_since_.value_or(now);
        return;
    }
    if (const auto since = std::exchange(unwatched_since_, std::nullopt);
        since && now - *since > k_unwatched_seconds)
        clock_.rest();
}

void Viewer::carry_out(const live::GiveUpSeek&) {
    if (!stepping_)
        return;
    // A half-drawn frame does not count.
    const int next = stepping_->where().frame + (stepping_->frame() ? 0 : 1);
    drop_frame();
    const double now = now_seconds();
    clock_.seek(next / settings_.frames.state.fps, next, now);
    if (!clock_.paused())
        clock_.toggle_pause(now);
    stale_ = true;
}

void Viewer::carry_out(const live::SetSpeed& command) {
    clock_.set_speed(command.speed, now_seconds());
}

void Viewer::carry_out(const live::SetLoop& command) {
    loop_ = command;
}

void Viewer::go_round(double now) {
    if (!loop_.from || !loop_.to || *loop_.from >= *loop_.to || !moving() || making_ || recording())
        return;
    const double time = clock_.time(now);
    const bool back = clock_.speed() < 0;
    if (back ? time <= *loop_.from : time >= *loop_.to)
        seek(back ? *loop_.to : *loop_.from, now);
}

} // namespace tidemark::cli
