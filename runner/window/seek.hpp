// Steps to a frame of a scene with feedback: draws the frames before it, a few at a time and slow ones in
// parts, so that the window goes on meanwhile.
#pragma once

#include "host/overlay_fields.hpp"
#include "render/frame_in_parts.hpp"
#include "render/frame_stepper.hpp"
#include "window/frame_pacing.hpp"

namespace tidemark::cli {

class SteppingThere {
public:
    /// Draws all frames up to `frame`, the one before that at `seconds`. The references must outlive it, and
    /// nothing else may draw with `renderer` meanwhile.
    SteppingThere(render::Renderer& renderer, render::FramePace& pace, render::PartSize& size,
                  render::FrameStates states, int frame, double seconds);
    SteppingThere(const SteppingThere&) = delete;
    SteppingThere& operator=(const SteppingThere&) = delete;

    /// Draws for that time, at least one frame or a part of one. Returns whether `frame` is drawn.
    bool advance(double seconds);
    double seconds() const { return seconds_; }
    /// Returns the frame being drawn, and the last one.
    const live::Stepping& where() const { return where_; }

    /// Returns the slow frame that is drawn in parts at the moment; null: none.
    const render::FrameInParts* frame() const { return frame_ ? &*frame_ : nullptr; }
    /// Cancels the frame in progress; returns the driver's current part, which cannot be stopped.
    std::optional<render::FrameInParts::UnderWay> give_up();

private:
    bool draw(const render::FrameInputs& inputs);
    void draw_whole(const render::FrameInputs& inputs);

    render::Renderer& renderer_;
    render::FramePace& pace_;
    render::PartSize& size_;
    render::FrameStepper stepper_;
    std::optional<render::FrameInParts> frame_; ///< none: no frame is half drawn
    double until_ = 0;                          ///< end of the current call of advance
    double seconds_;
    live::Stepping where_;
};

} // namespace tidemark::cli
