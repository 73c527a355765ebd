// On the way to a frame of a scene with feedback: the frames that lead there are drawn a few at a time, so
// that the window goes on meanwhile.
#pragma once

#include "live/time_field.hpp"
#include "render/frame_stepper.hpp"

namespace tidemark::cli {

class SteppingThere {
public:
    /// To the frame before the one at `seconds`. `renderer` must outlive it, and draws nothing else
    /// meanwhile.
    SteppingThere(render::Renderer& renderer, render::FrameStates states, int frame, double seconds)
        : stepper_(renderer, std::move(states)), seconds_(seconds), where_{0, frame} {}

    /// Draws for so long, one frame at least; whether the frame is there.
    bool advance(double seconds);
    double seconds() const { return seconds_; }
    const live::Stepping& where() const { return where_; }

private:
    render::FrameStepper stepper_;
    double seconds_;
    live::Stepping where_; ///< the frame that was drawn last, of those that are drawn
};

} // namespace tidemark::cli
