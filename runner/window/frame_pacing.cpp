#include "window/frame_pacing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tidemark::render {
namespace {

constexpr int k_smallest = -3;
constexpr int k_largest = 1;

} // namespace

std::vector<RenderScale> RenderScale::all() {
    std::vector<RenderScale> scales;
    for (int exponent = k_smallest; exponent <= k_largest; ++exponent)
        scales.push_back(RenderScale(exponent));
    return scales;
}

std::optional<RenderScale> RenderScale::named(std::string_view name) {
    const std::vector<RenderScale> scales = all();
    const auto found = std::ranges::find(scales, name, &RenderScale::name);
    return found == scales.end() ? std::nullopt : std::optional(*found);
}

std::string RenderScale::name() const {
    return exponent_ < 0 ? fmt::format("1/{}", 1 << -exponent_) : fmt::format("{}", 1 << exponent_);
}

Extent RenderScale::drawn(Extent window) const {
    const auto scaled = [this](int length) {
        return std::max(1, int(std::lround(std::ldexp(double(length), exponent_))));
    };
    return {scaled(window.width), scaled(window.height)};
}

RenderScale RenderScale::stepped(int steps) const {
    return RenderScale(std::clamp(exponent_ + steps, k_smallest, k_largest));
}

namespace {

/// The median of five frames ignores two slow ones.
constexpr size_t k_frames_down = 5;
constexpr size_t k_frames_up = 30;
/// Fractions of the budget. Between the two the scale stays: frames that take the whole budget occasionally
/// measure up to a tenth more or a fifth less.
constexpr double k_too_slow = 1.1;
constexpr double k_fast_enough = 0.8;

double median_of_last(const std::deque<double>& values, size_t count) {
    std::vector<double> last(values.end() - std::ptrdiff_t(count), values.end());
    const auto middle = last.begin() + std::ptrdiff_t(count / 2);
    std::ranges::nth_element(last, middle);
    return *middle;
}

} // namespace

RenderScale AdaptiveScale::after_frame(RenderScale scale, double milliseconds) {
    recent_.push_back(milliseconds);
    if (recent_.size() > k_frames_up)
        recent_.pop_front();
    auto wanted = lower(scale);
    if (wanted && before_step_up_) // a step that is undone shows its cost
        growth_ = std::max(growth_, median_of_last(recent_, k_frames_down) / *before_step_up_);
    if (wanted || recent_.size() == k_frames_up)
        before_step_up_.reset();
    if (!wanted)
        wanted = higher(scale);
    if (!wanted)
        return scale;
    recent_.clear();
    return *wanted;
}

void AdaptiveScale::forget() {
    recent_.clear();
    before_step_up_.reset();
    growth_ = k_pixels;
}

/// Returns the next scale whose frames may be quick enough. The time falls at most in proportion to the
/// pixels, so the scale is not lower than necessary.
std::optional<RenderScale> AdaptiveScale::lower(RenderScale scale) const {
    if (recent_.size() < k_frames_down)
        return std::nullopt;
    double expected = median_of_last(recent_, k_frames_down);
    if (expected <= k_too_slow * budget_)
        return std::nullopt;
    RenderScale wanted = scale;
    while (expected > budget_ && wanted.stepped(-1) != wanted) {
        wanted = wanted.stepped(-1);
        expected /= k_pixels;
    }
    return wanted == scale ? std::nullopt : std::optional(wanted);
}

std::optional<RenderScale> AdaptiveScale::higher(RenderScale scale) {
    if (recent_.size() < k_frames_up || scale.stepped(1) == scale)
        return std::nullopt;
    const double now = median_of_last(recent_, k_frames_up);
    if (now * growth_ > k_fast_enough * budget_)
        return std::nullopt;
    before_step_up_ = now;
    return scale.stepped(1);
}

namespace {

/// Too short a delay to be noticed. A frame that waits for the screen at 24 Hz takes less.
constexpr double k_whole_seconds = 0.05;
/// Between the two limits the way stays the same.
constexpr double k_whole_again_seconds = 0.03;

} // namespace

std::optional<double> FramePace::expected(Extent extent) const {
    return seconds_of_pixel_ ? std::optional(*seconds_of_pixel_ * double(extent.pixels())) : std::nullopt;
}

FramePace::Way FramePace::way(Extent extent) const {
    const double longest = last_ == Way::whole ? k_whole_seconds : k_whole_again_seconds;
    return expected(extent).value_or(longest) < longest ? Way::whole : Way::in_parts;
}

void FramePace::took(Extent extent, Way way, double seconds) {
    if (extent.pixels() == 0)
        return;
    seconds_of_pixel_ = seconds / double(extent.pixels());
    last_ = way;
}

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

FrameState LiveClock::next_frame(double now, FrameState state) {
    measure_rate(now);
    state.frame = next_frame_;
    state.fps = frames_per_second_.value_or(frame_rate_);
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
