// Rendered pixels per window pixel along a side: a power of two.
#pragma once

#include "base/extent.hpp"
#include "render/frame_state.hpp"

#include <compare>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::render {

class RenderScale {
public:
    RenderScale() = default; ///< 1: renders each window pixel
    /// Lists the scales from the smallest to the largest.
    static std::vector<RenderScale> all();
    /// Finds the scale of that `name`.
    static std::optional<RenderScale> named(std::string_view name);

    /// Returns `1/4`, `1` or `2`, for example.
    std::string name() const;
    /// Returns the size to render for a window of that size; at least one pixel a side.
    Extent drawn(Extent window) const;
    /// Returns the scale `steps` powers of two higher, or lower if negative, within the range.
    RenderScale stepped(int steps) const;
    /// Returns the number of steps from `other` to this scale.
    int steps_from(RenderScale other) const { return exponent_ - other.exponent_; }

    auto operator<=>(const RenderScale&) const = default;

private:
    explicit RenderScale(int exponent) : exponent_(exponent) {}

    int exponent_ = 0;
};

// Chooses the render scale that holds a frame rate, from the time of each frame. The scale falls soon, rises
// late, and ignores a few slow frames.

class AdaptiveScale {
public:
    explicit AdaptiveScale(double fps) : budget_(1000 / fps) {}

    /// Returns the scale of the next frame after a frame in `scale` took that long.
    RenderScale after_frame(RenderScale scale, double milliseconds);
    /// Discards all measurements; for changes after which frames may take a different time.
    void forget();

private:
    std::optional<RenderScale> lower(RenderScale scale) const;
    std::optional<RenderScale> higher(RenderScale scale);

    double budget_;                        ///< milliseconds per frame
    std::deque<double> recent_;            ///< times of frames in the current scale, the newest last
    double growth_ = k_pixels;             ///< factor of a frame's time for twice as many pixels along a side
    std::optional<double> before_step_up_; ///< milliseconds; set while the last step up may still be undone

    static constexpr double k_pixels = 4;
};

// Decides whether a frame is drawn in one go without a noticeable delay of the window, or in parts. Pure: the
// input is the time of earlier frames.

class FramePace {
public:
    enum class Way { whole, in_parts };

    /// Returns the expected seconds of the next frame of that size; nothing when unknown.
    std::optional<double> expected(Extent extent) const;
    /// Returns the way to draw the next frame of that size: in parts when its time is unknown.
    Way way(Extent extent) const;
    /// Records the seconds of a frame of that size, drawn in that way.
    void took(Extent extent, Way way, double seconds);
    /// Discards the measurement; for changes after which frames may take a different time.
    void doubt() { seconds_of_pixel_.reset(); }

private:
    std::optional<double> seconds_of_pixel_; ///< empty: unknown
    Way last_ = Way::in_parts;
};

// Time in a window: iTime, iTimeDelta, iFrame and iFrameRate from the wall clock, or from the frames alone,
// with pause, step and restart. The caller passes the time, so that tests need not wait.

/// Follows ShaderToy: pause freezes iTime, but frames drawn meanwhile still count in iFrame; the first frame
/// after a start, restart, resume, step or rest has iTimeDelta = 1/60; iFrameRate is a mean over at least
/// half a second and starts at 60. `now` is in seconds from any origin and never decreases.
class LiveClock {
public:
    /// With `frames_per_second`, every frame has the inputs of inputs_of_frame, also during a pause, so that
    /// each frame can be drawn again.
    explicit LiveClock(double now, std::optional<double> frames_per_second = {})
        : frames_per_second_(frames_per_second), resumed_at_(now), window_start_(now) {}

    bool paused() const { return paused_; }
    void toggle_pause(double now);
    void restart(double now);
    /// Pauses and moves by `frames` frames of 1/fps; never before frame 0 or time 0.
    void step(int frames, double fps, double now);

    /// Sets the time and the number of the next frame.
    void seek(double time, int frame, double now);
    /// Sets the seconds of iTime per second of wall clock; with a negative speed iTime runs backwards, down
    /// to 0. Frame numbers still increase.
    void set_speed(double speed, double now);
    double speed() const { return speed_; }
    bool by_frames() const { return frames_per_second_.has_value(); }

    /// Excludes a break between frames from the next iTimeDelta.
    void rest() { fresh_ = true; }

    /// Returns the state of the frame to draw now, and counts it. `state` holds the fields that do not follow
    /// the clock.
    FrameState next_frame(double now, FrameState state = {});
    /// Takes back the last `next_frame`, which was not drawn: the next frame gets its number.
    void give_frame_back();
    /// Returns iTime at `now`.
    double time(double now) const { return time_at(now); }
    int next_frame_number() const { return next_frame_; }
    double frame_rate() const { return frame_rate_; }

private:
    double time_at(double now) const;
    void measure_rate(double now);

    std::optional<double> frames_per_second_; ///< none: the wall clock
    double time_ = 0;                         ///< iTime at resumed_at_, or frozen
    double resumed_at_;                       ///< wall clock
    double speed_ = 1;
    double drawn_at_ = 0;
    int next_frame_ = 0;
    bool paused_ = false;
    bool fresh_ = true; ///< nothing drawn since start, restart, resume, step or rest
    double window_start_;
    int window_frames_ = 0;
    double frame_rate_ = 60;
};

} // namespace tidemark::render
