#include "window/timeline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tidemark::window {
namespace {

constexpr double k_usual_delta = 1 / 60.0;
constexpr double k_rate_window = 0.5;

/// A longer time without a viewer is not part of iTimeDelta.
constexpr double k_unwatched_seconds = 1;

} // namespace

void Timeline::begin(double now) {
    Timeline begun(now, fps_, source_);
    begun.loop_ = loop_;
    begun.next_scene_at_ = next_scene_at_;
    *this = begun;
}

void Timeline::toggle_pause(double now) {
    time_ = time(now);
    resumed_at_ = now;
    paused_ = !paused_;
    fresh_ = true;
}

void Timeline::restart(double now) {
    time_ = 0;
    resumed_at_ = now;
    next_frame_ = 0;
    fresh_ = true;
    fit_bar();
}

void Timeline::seek(double time, int frame, double now) {
    time_ = time;
    resumed_at_ = now;
    next_frame_ = frame;
    fresh_ = true;
}

std::optional<int> Timeline::frame_at(double seconds) const {
    if (!(seconds >= 0 && seconds <= render::k_last_frame / fps_))
        return std::nullopt;
    return render::frame_at(seconds, fps_);
}

void Timeline::pause_at(int frame, double now) {
    seek(frame / fps_, frame, now);
    if (!paused_)
        toggle_pause(now);
}

std::optional<double> Timeline::loop_jump(double now) const {
    if (!loop_.from || !loop_.to || *loop_.from >= *loop_.to)
        return std::nullopt;
    const bool back = speed_ < 0;
    const bool passed = back ? time(now) <= *loop_.from : time(now) >= *loop_.to;
    return passed ? (back ? loop_.to : loop_.from) : std::nullopt;
}

void Timeline::watch(bool watched, double now) {
    if (!watched)
        unwatched_since_ = unwatched_since_.value_or(now);
    else if (const auto since = std::exchange(unwatched_since_, std::nullopt);
             since && now - *since > k_unwatched_seconds)
        rest();
}

overlay::TimeField Timeline::field(const render::FrameState& shown) const {
    return {.seconds = shown.seconds(),
            .frame = shown.frame,
            .paused = paused_,
            .speed = speed_,
            .has_speed = !by_frames(),
            .loop_from = loop_.from,
            .loop_to = loop_.to,
            .bar_end = bar_end(shown.seconds()),
            .bar_held = bar_held_,
            .frame_rate = paused_ ? 0 : frame_rate_};
}

double Timeline::bar_end(double shown) const {
    if (bar_held_)
        return shortest_bar_;
    return std::max(shortest_bar_, overlay::bar_end({.seconds = shown, .loop_to = loop_.to}));
}

void Timeline::hold_bar(double shown) {
    shortest_bar_ = bar_end(shown);
    bar_held_ = true;
}

void Timeline::grow_bar(double shown) {
    shortest_bar_ = std::min(2 * bar_end(shown), render::k_last_frame / fps_);
}

void Timeline::fit_bar() {
    if (!bar_held_)
        shortest_bar_ = 0;
}

void Timeline::set_speed(double speed, double now) {
    time_ = time(now);
    resumed_at_ = now;
    speed_ = speed;
}

void Timeline::step(int frames, double now) {
    if (!paused_)
        toggle_pause(now);
    // `next_frame_` is one more than the frame on show.
    next_frame_ = std::max(0, next_frame_ - 1 + frames);
    time_ = std::max(0.0, time_ + frames / fps_);
    fresh_ = true;
}

double Timeline::time(double now) const {
    if (by_frames())
        return next_frame_ / fps_;
    return paused_ ? time_ : std::max(0.0, time_ + speed_ * (now - resumed_at_));
}

render::FrameState Timeline::next_frame(double now, render::FrameState state) {
    measure_rate(now);
    state.frame = next_frame_;
    state.fps = by_frames() ? fps_ : frame_rate_;
    if (!by_frames()) {
        state.time = time(now);
        state.time_delta = fresh_ || paused_ ? k_usual_delta : std::abs(speed_) * (now - drawn_at_);
    }
    ++next_frame_;
    drawn_at_ = now;
    fresh_ = false;
    return state;
}

void Timeline::give_frame_back() {
    next_frame_ = std::max(0, next_frame_ - 1);
    fresh_ = true;
}

void Timeline::measure_rate(double now) {
    if (fresh_) {
        window_start_ = now;
        window_frames_ = 0;
        return;
    }
    ++window_frames_;
    if (now - window_start_ < k_rate_window)
        return;
    frame_rate_ = window_frames_ / (now - window_start_);
    window_start_ = now;
    window_frames_ = 0;
}

} // namespace tidemark::window
