// On the way to a frame of a scene with feedback: the frames that lead there are drawn a few at a time, and
// slow ones in parts, so that the window goes on meanwhile.
#pragma once

#include "live/time_field.hpp"
#include "render/frame_in_parts.hpp"
#include "render/frame_pace.hpp"
#include "render/frame_stepper.hpp"

namespace tidemark::cli {

class SteppingThere {
public:
    /// To the frame before the one at `seconds`. What it is given must outlive it, and `renderer` draws
    /// nothing else meanwhile.
    SteppingThere(render::Renderer& renderer, render::FramePace& pace, render::PartSize& size,
                  render::FrameStates states, int frame, double seconds);
    SteppingThere(const SteppingThere&) = delete;
    SteppingThere& operator=(const SteppingThere&) = delete;

    /// Draws for so long, one frame or a part of one at least; whether the frame is there.
    bool advance(double seconds);
    double seconds() const { return seconds_; }
    /// The frame that is being drawn, of those that are drawn.
    const live::Stepping& where() const { return where_; }

    /// What the driver is at, in the parts of a slow frame.
    const render::FrameInParts* frame() const { return frame_ ? &*frame_ : nullptr; }
    /// It goes no further.
    std::optional<render::FrameInParts::UnderWay> give_up();

private:
    bool draw(const render::FrameInputs& inputs);
    void draw_whole(const render::FrameInputs& inputs);

    render::Renderer& renderer_;
    render::FramePace& pace_;
    render::PartSize& size_;
    render::FrameStepper stepper_;
    std::optional<render::FrameInParts> frame_; ///< none: nothing is half drawn
    double until_ = 0;                          ///< of the call under way
    double seconds_;
    live::Stepping where_;
};

} // namespace tidemark::cli
