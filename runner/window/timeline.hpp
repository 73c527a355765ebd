// Time in a window: iTime, iTimeDelta, iFrame and iFrameRate from the wall clock, or from the frames alone,
// with pause, step, speed, seek and loop. The caller passes the time, so that tests need not wait.
#pragma once

#include "host/overlay_model.hpp"
#include "render/frame_state.hpp"

#include <optional>

namespace tidemark::window {

/// Follows ShaderToy: pause freezes iTime, but frames drawn meanwhile still count in iFrame; the first frame
/// after a start, restart, resume, step or rest has iTimeDelta = 1/60; iFrameRate is a mean over at least
/// half a second and starts at 60. `now` is in seconds from any origin and never decreases.
class Timeline {
public:
    /// The source of iTime. With `frames`, every frame has the inputs of inputs_of_frame, also during a
    /// pause, so that each frame can be drawn again.
    enum class Source { wall_clock, frames };

    /// `fps` is the rate of Source::frames, of steps, and of the frame numbers after a seek.
    explicit Timeline(double now, double fps = 60, Source source = Source::wall_clock)
        : fps_(fps), source_(source), resumed_at_(now), window_start_(now) {}
    /// Starts again as a new object does; keeps the loop and the seek for the next scene.
    void begin(double now);

    bool paused() const { return paused_; }
    void toggle_pause(double now);
    void restart(double now);
    /// Pauses and moves by that many frames; never before frame 0 or time 0.
    void step(int frames, double now);

    /// Returns the number of the frame at that time; nothing for a time before 0 or after the last frame.
    std::optional<int> frame_at(double seconds) const;
    /// Sets the time and the number of the next frame.
    void seek(double time, int frame, double now);
    /// Stays, paused, at a frame that is the next one to be drawn.
    void pause_at(int frame, double now);
    /// Sets the time at which the next scene begins; none: it continues from the current time.
    void begin_next_scene_at(std::optional<double> time) { next_scene_at_ = time; }
    /// Returns that time, once.
    std::optional<double> take_next_scene_time() { return std::exchange(next_scene_at_, std::nullopt); }

    /// Sets the seconds of iTime per second of wall clock; with a negative speed iTime runs backwards, down
    /// to 0. Frame numbers still increase.
    void set_speed(double speed, double now);
    double speed() const { return speed_; }
    bool by_frames() const { return source_ == Source::frames; }

    void set_loop(const overlay::SetLoop& loop) { loop_ = loop; }
    /// Returns the time to seek to because iTime has passed the loop's end; nothing before that, or without a
    /// loop.
    std::optional<double> loop_jump(double now) const;

    /// Excludes a break between frames from the next iTimeDelta.
    void rest() { fresh_ = true; }
    /// Call it regularly: excludes a time of more than a second in which the picture is not watched.
    void watch(bool watched, double now);

    /// Returns the state of the frame to draw now, and counts it. `state` holds the fields that do not follow
    /// the clock.
    render::FrameState next_frame(double now, render::FrameState state = {});
    /// Takes back the last `next_frame`, which was not drawn: the next frame gets its number.
    void give_frame_back();
    /// Returns iTime at `now`.
    double time(double now) const;
    int next_frame_number() const { return next_frame_; }
    double frame_rate() const { return frame_rate_; }

    /// Returns the time bar's contents for the frame on show.
    overlay::TimeField field(const render::FrameState& shown) const;
    /// Keeps the bar's end, at `shown` seconds, until it is released.
    void hold_bar(double shown);
    void release_bar() { bar_held_ = false; }
    /// Doubles the bar's range.
    void grow_bar(double shown);
    /// Makes the bar only as long as the next time needs, unless it is held.
    void fit_bar();

private:
    void measure_rate(double now);
    double bar_end(double shown) const;

    double fps_;
    Source source_;
    double time_ = 0;   ///< iTime at resumed_at_, or frozen
    double resumed_at_; ///< wall clock
    double speed_ = 1;
    double drawn_at_ = 0;
    int next_frame_ = 0;
    bool paused_ = false;
    bool fresh_ = true; ///< nothing drawn since start, restart, resume, step or rest
    double window_start_;
    int window_frames_ = 0;
    double frame_rate_ = 60;
    overlay::SetLoop loop_;
    double shortest_bar_ = 0; ///< the bar's end is not before this one
    bool bar_held_ = false;
    std::optional<double> next_scene_at_{};
    std::optional<double> unwatched_since_{};
};

} // namespace tidemark::window
