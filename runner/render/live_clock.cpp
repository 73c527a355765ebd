#include "render/live_clock.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::render {
namespace {

constexpr double k_usual_delta = 1 / 60.0;
constexpr double k_rate_window = 0.5;

} // namespace

void LiveClock::toggle_pause(double now) {
    time_ = time_at(now);
    resumed_at_ = now;
    paused_ = !paused_;
    fresh_ = true;
}

void LiveClock::restart(double now) {
    time_ = 0;
    resumed_at_ = now;
    next_frame_ = 0;
    fresh_ = true;
}

void LiveClock::seek(double time, int frame, double now) {
    time_ = time;
    resumed_at_ = now;
    next_frame_ = frame;
    fresh_ = true;
}

void LiveClock::set_speed(double speed, double now) {
    time_ = time_at(now);
    resumed_at_ = now;
    speed_ = speed;
}

void LiveClock::step(int frames, double fps, double now) {
    if (!paused_)
        toggle_pause(now);
    // `next_frame_` is one more than the frame on show.
    next_frame_ = std::max(0, next_frame_ - 1 + frames);
    time_ = std::max(0.0, time_ + frames / fps);
    fresh_ = true;
}

double LiveClock::time_at(double now) const {
    if (frames_per_second_)
        return next_frame_ / *frames_per_second_;
    return paused_ ? time_ : std::max(0.0, time_ + speed_ * (now - resumed_at_));
}

FrameState LiveClock::next_frame(double now) {
    measure_rate(now);
    FrameState state{.frame = next_frame_, .fps = frames_per_second_.value_or(frame_rate_)};
    if (!frames_per_second_) {
        state.time = time_at(now);
        state.time_delta = fresh_ || paused_ ? k_usual_delta : std::abs(speed_) * (now - drawn_at_);
    }
    ++next_frame_;
    drawn_at_ = now;
    fresh_ = false;
    return state;
}

void LiveClock::give_frame_back() {
    next_frame_ = std::max(0, next_frame_ - 1);
    fresh_ = true;
}

void LiveClock::measure_rate(double now) {
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

} // namespace tidemark::render
