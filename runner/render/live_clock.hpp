// Time in a window: iTime, iTimeDelta, iFrame and iFrameRate from the wall clock, or from the frames alone,
// with pause, step and restart. Told what time it is by its caller, so that it can be tested without waiting.
#pragma once

#include "render/frame_state.hpp"

#include <optional>

namespace tidemark::render {

/// ShaderToy's rules: pause freezes iTime, but a frame that is drawn meanwhile still counts in iFrame; the
/// first frame after a start, restart, resume, step or rest has iTimeDelta = 1/60; iFrameRate is a mean over
/// at least half a second and starts at 60. `now` is in seconds from any origin and never runs backwards.
class LiveClock {
public:
    /// With `frames_per_second` every frame has the inputs of inputs_of_frame, one that is drawn in a pause
    /// too: what is drawn can be drawn again.
    explicit LiveClock(double now, std::optional<double> frames_per_second = {})
        : frames_per_second_(frames_per_second), resumed_at_(now), window_start_(now) {}

    bool paused() const { return paused_; }
    void toggle_pause(double now);
    void restart(double now);
    /// Pauses and moves by so many frames of 1/fps; never before frame 0 or time 0.
    void step(int frames, double fps, double now);

    /// That frame is next, at that time.
    void seek(double time, int frame, double now);
    /// Seconds of iTime in one of the wall clock's; below zero iTime runs backwards, down to 0. Frames are
    /// counted on.
    void set_speed(double speed, double now);
    double speed() const { return speed_; }
    bool by_frames() const { return frames_per_second_.has_value(); }

    /// No frame is drawn for a while, which is no frame's iTimeDelta.
    void rest() { fresh_ = true; }

    /// The frame to draw now. Counts it.
    FrameState next_frame(double now);
    /// The frame that `next_frame` gave last is not drawn: its number is the next one's.
    void give_frame_back();
    /// iTime at that moment.
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
