// Draws any frame of a run, whatever was drawn before: where a frame depends on the one before it, those that
// lead to it are drawn first; otherwise it jumps.
#pragma once

#include "render/frame_state.hpp"
#include "render/pass_preview.hpp"
#include "render/renderer.hpp"

#include <functional>
#include <optional>

namespace tidemark::render {

/// What was drawn on the way to a frame, the frame included.
struct FrameSteps {
    int frames = 0;
    size_t passes = 0;    ///< 0: every pass had its picture already
    bool complete = true; ///< false: it was stopped before the end
};

class FrameStepper {
public:
    /// Asked before each frame that is drawn on the way to `last`; false stops there.
    using MayDraw = std::function<bool(int frame, int last)>;

    /// `first`: the frame that a scene with feedback is drawn from. Buffers may hold anything.
    FrameStepper(Renderer& renderer, FrameStates states, int first = 0)
        : renderer_(renderer), states_(std::move(states)), first_(first) {}
    /// Of the run that a state is in.
    FrameStepper(Renderer& renderer, const FrameState& state, int first = 0)
        : FrameStepper(
              renderer, [state](int frame) { return state.at_frame(frame); }, first) {}

    /// Draws a frame; false: not all of it yet, and none is counted. It is asked for again then.
    using DrawFrame = std::function<bool(const FrameInputs&)>;
    /// Instead of by the renderer, whole.
    void draw_by(DrawFrame draw) { draw_frame_ = std::move(draw); }

    FrameSteps draw(int frame, const MayDraw& may_draw = {});
    /// All that `draw` draws but the frame itself: buffers hold what it would see.
    FrameSteps lead_to(int frame, const MayDraw& may_draw = {});
    /// The renderer's buffers hold what leads to that frame, by whatever way.
    void start_from(int frame) { next_ = frame; }
    /// Goes on into the frame. What is asked for next begins anew.
    PassPreview preview(int frame, size_t pass, const MayDraw& may_draw = {});

private:
    FrameSteps step(int end, int last, const MayDraw& may_draw);

    Renderer& renderer_;
    FrameStates states_;
    int first_;
    DrawFrame draw_frame_{};
    std::optional<int> next_{}; ///< the frame that the buffers are ready for; none: they are not
};

} // namespace tidemark::render
