// Time in a window: iTime, iTimeDelta, iFrame and iFrameRate from the wall clock, or from the frames alone,
// with pause, step and restart. The caller passes the time, so that tests need not wait.
#pragma once

#include "render/frame_state.hpp"

#include <optional>

namespace tidemark::render {

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

    /// Returns the state of the frame to draw now, and counts it.
    FrameState next_frame(double now);
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
