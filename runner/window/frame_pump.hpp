// When and how the window draws: the choice between whole frames and parts, the interface of the object that
// draws, and the pump that runs it.
//
// Decides whether a frame is drawn in one go without a noticeable delay of the window, or in parts. Pure: the
// input is the time of earlier frames.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "host/overlay_fields.hpp"
#include "render/frame_in_parts.hpp"
#include "render/frame_state.hpp"
#include "render/picture_parts.hpp"
#include "render/renderer.hpp"
#include "window/screen.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::window {

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

// The interface that frames are drawn through, by a Stage or a test. FramePump decides when, and how much of
// a frame at a time.

/// A part of a frame that the driver is drawing.
struct DriverWork {
    render::Part part;
    double begun = 0;
    /// Waits up to that many seconds; returns whether the part is drawn.
    std::function<bool(double seconds)> wait;
};

/// A frame that is drawn in parts. Dropping it leaves the pictures of its maker unchanged.
class FrameParts {
public:
    FrameParts() = default;
    FrameParts(const FrameParts&) = delete;
    FrameParts& operator=(const FrameParts&) = delete;
    virtual ~FrameParts() = default;

    /// Draws for `seconds`. Returns whether the frame is complete; fails if the memory does not suffice for
    /// parts.
    virtual Result<bool> draw_for(double seconds) = 0;
    /// Returns whether the frame, now complete, had a pass to draw.
    virtual bool drew_pass() const = 0;
    /// Returns the drawn fraction of the frame, 0 to 1.
    virtual double share() const = 0;
    virtual const std::vector<render::FrameInParts::PassSeconds>& seconds() const = 0;
    /// Returns the part in progress, until the next `draw_for`.
    virtual std::optional<DriverWork> work() const = 0;
    /// Abandons the frame. Returns the part in progress, which cannot be stopped.
    virtual std::optional<DriverWork> cancel() = 0;
};

class FrameMaker {
public:
    FrameMaker() = default;
    FrameMaker(FrameMaker&&) = default;
    FrameMaker& operator=(FrameMaker&&) = default;
    virtual ~FrameMaker() = default;

    virtual Extent extent() const = 0;
    /// Draws one frame; returns whether a pass had to be drawn. Adds timers if `timers` is not null.
    virtual bool draw(const render::FrameInputs& inputs, std::vector<render::PassTimer>* timers) = 0;
    /// Begins a frame in parts. The result must not outlive the maker or `size`.
    virtual std::unique_ptr<FrameParts> begin(const render::FrameInputs& inputs, render::PartSize& size) = 0;
    /// Waits until everything is drawn.
    virtual void finish() = 0;
    /// Clears all buffers, as before frame 0.
    virtual void reset() = 0;
};

// Draws frames, fast ones whole and slow ones in parts over several rounds of the event loop, so that events
// are handled in between. The last frame stays on show until the next one is complete.

class FramePump {
public:
    /// `running`: frames follow each other. `still`: the next frame would be the same, until there is input.
    /// `cancelled`: slow frames were cancelled, and none is drawn until the user requests one.
    enum class Flow { running, still, cancelled };

    /// A part that takes longer is reported.
    static constexpr double k_too_long_seconds = 2;

    /// The rest of the window, as far as it decides about frames.
    struct Around {
        bool watched = true;         ///< the screen can show a picture
        bool plays = true;           ///< there is a scene, and its time is not paused
        bool compiles = false;       ///< a reload is being compiled
        bool panels_changed = false; ///< the panels must be shown again
        bool events_held = false;    ///< events wait until the driver is free
    };

    /// A complete frame.
    struct Made {
        render::FrameState state;
        double begun = 0;                                         ///< when drawing it began
        bool drawn = true;                                        ///< a pass had to be drawn
        bool wanted = false;                                      ///< it shows a change by the user
        std::vector<render::FrameInParts::PassSeconds> seconds{}; ///< if it was drawn in parts
    };

    /// `fps` is the highest rate of frames.
    explicit FramePump(double fps, std::function<double()> clock = now_seconds)
        : fps_(fps), clock_(std::move(clock)), listened_at_(clock_()) {}

    // The round of the event loop

    /// Call it before events are handled. Returns whether the last frame has blocked the window for long: the
    /// events of that time refer to the picture before it, until `begin_waiting`. `drawn` is the picture's
    /// size.
    bool begin_round(Extent drawn);
    void begin_waiting() { blocked_ = false; }
    /// Call it after events were handled.
    void end_round() { listened_at_ = clock_(); }
    /// Returns whether to draw now: a frame, a part of one, or the panels alone.
    bool wants_frame(const Around& around, double now) const;
    /// Returns the time of the next round: of a frame, a part or a held event; infinity: none is due.
    double due(const Around& around, double now) const;

    // Frames

    /// Requests a frame, because the picture is out of date.
    void ask() { wanted_ = true; }
    /// Begins the frame that is due, if one is; returns whether it shows a change by the user.
    std::optional<bool> take_due(const Around& around, double now);
    /// Draws a frame, or its first part. Returns it if it is complete.
    std::optional<Made> begin(FrameMaker& maker, const render::FrameState& state,
                              const render::FrameInputs& inputs, bool wanted, double now,
                              std::vector<render::PassTimer>* timers = nullptr);
    /// Draws further parts. Returns the frame if it is complete; fails if the memory does not suffice for
    /// parts, and draws frames whole from then on.
    Result<std::optional<Made>> advance();
    /// Cancels the frame or the seek in progress. Returns whether it was a frame, whose number is free again.
    bool cancel();
    /// Draws none of the frames that follow until `resume`.
    void stop(double now);
    /// Draws frames again; returns whether they were stopped.
    bool resume();
    /// Declares whether the next frame would be the same as the last one.
    void set_still(bool still) { flow_ = still ? Flow::still : Flow::running; }
    /// Forgets the scene: another one is drawn from now on.
    void forget_scene();
    /// Declares that the scene has changed: nothing is known about its frames.
    void begin_scene();
    /// Discards the estimate of the frame time, as another time or setting may be slower. The first parts of
    /// the next frame measure it.
    void doubt(Extent drawn);

    // Seeks: all frames up to one are drawn, so that feedback has its usual contents

    /// Begins to draw the frames 0 to `last`, the one before the frame at `seconds`.
    void seek(FrameMaker& maker, render::FrameStates states, int last, double seconds);
    bool seeking() const { return seek_.has_value(); }
    /// Draws frames for that time, at least one or a part of one. Returns the `seconds` of `seek` when all
    /// are drawn, which ends it.
    std::optional<double> advance_seek(double seconds);
    /// Returns the last frame that was begun, and the last one to draw.
    const overlay::Stepping& seek_progress() const { return seek_->where; }
    /// Returns the number of the first frame that is not drawn yet.
    int seek_next() const { return seek_->next; }

    // State

    Flow flow() const { return flow_; }
    bool drawing() const { return making_.has_value(); } ///< a frame is half drawn
    /// Returns whether frames follow each other without events.
    bool moving(const Around& around) const;
    /// Returns whether a frame in parts is to be continued.
    bool goes_on(const Around& around, double now) const;
    /// Returns whether to show the panels without a new frame of the scene. A moving scene shows them along
    /// with its frames.
    bool shows_panels(const Around& around) const;
    /// Returns the expected seconds of a frame of that size; nothing when unknown.
    std::optional<double> expected(Extent extent) const { return pace_.expected(extent); }
    /// Returns whether drawing the frame on show again as a whole would block the window.
    bool would_block(Extent drawn) const;
    /// Returns whether the frame in progress takes long.
    bool draws_for_long(double now) const;
    /// Returns whether Esc cancels frames: one takes long, or the last one did.
    bool can_stop(const Around& around, double now) const;
    /// Returns whether frames were stopped a moment ago, so that Esc, pressed again, means the same frame.
    bool just_stopped(double now) const;
    /// Returns whether the driver is busy for longer than a round; any other GL call would wait as long.
    bool driver_busy() const;
    /// Returns whether the driver has been busy with one part for long.
    bool driver_held(double now) const;
    /// Returns whether the driver still draws a part of a cancelled frame.
    bool ending() const { return ending_.has_value(); }

    // Words for the user

    /// Returns the progress of a slow frame; empty: there is none. `has_frame`: the picture is up to date.
    std::string progress(double now, bool has_frame) const;
    /// Returns whether the progress on show is out of date.
    bool progress_due(double now) const;
    void progress_shown(double now) { progress_shown_at_ = now; }
    /// Returns whether frames take so long that each shows its progress.
    bool frames_show_progress() const { return shows_progress_; }
    /// Returns how far the frame that is to be cancelled is, or how long frames take.
    std::string share_text(double now) const;
    /// Returns a part that takes too long, once for each frame. An endless loop cannot be distinguished from
    /// a very long one.
    std::optional<render::Part> take_slow_part(double now);

private:
    /// A frame that is drawn in parts.
    struct Making {
        Made frame;
        std::unique_ptr<FrameParts> parts;
        Extent extent;
        bool reported = false; ///< `take_slow_part` has returned a part
    };
    struct Seek {
        FrameMaker* maker; ///< not owned
        render::FrameStates states;
        double seconds;
        overlay::Stepping where;
        int next = 0;
        std::unique_ptr<FrameParts> parts{}; ///< of a slow frame; null: no frame is half drawn
    };
    bool draw_seek_frame(const render::FrameInputs& inputs, double until);
    void remember_duration(double seconds);
    void draw_whole(FrameMaker& maker, const render::FrameInputs& inputs);
    std::optional<DriverWork> work() const;
    bool waits_for_reload(const Around& around, double now) const;

    double fps_;
    std::function<double()> clock_;
    Flow flow_ = Flow::running;
    FramePace pace_;
    render::PartSize part_size_;
    std::optional<Making> making_;     ///< none: no frame is half drawn
    std::optional<Seek> seek_;         ///< none: no seek; never together with a frame
    std::optional<DriverWork> ending_; ///< the driver's part of a cancelled frame
    bool parts_fail_ = false;          ///< there is not enough memory for them
    bool wanted_ = true;               ///< the picture is out of date
    double next_draw_ = 0;
    double listened_at_;          ///< when events were last handled
    double held_seconds_ = 0;     ///< time before that without handling events
    bool blocked_ = false;        ///< handling the events that came in that time
    bool drew_ = false;           ///< a frame was drawn whole since then
    bool slow_ = false;           ///< the last drawn frame blocked the window, or took as long
    bool shows_progress_ = false; ///< the last frames took long enough to show their progress
    double stopped_at_ = 0;
    double progress_shown_at_ = 0;
};

} // namespace tidemark::window
