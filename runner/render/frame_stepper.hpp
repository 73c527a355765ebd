// Draws any frame of a run. If frames depend on the previous one, the frames that lead to it are drawn first;
// otherwise it jumps.
#pragma once

#include "render/frame_state.hpp"
#include "render/pass_preview.hpp"
#include "render/renderer.hpp"

#include <functional>
#include <optional>

namespace tidemark::render {

/// Work done for a frame, the frame itself included.
struct FrameSteps {
    int frames = 0;
    size_t passes = 0;    ///< 0: all pictures were up to date
    bool complete = true; ///< false: stopped early
};

class FrameStepper {
public:
    /// Called before each frame that is drawn on the way to `last`; returns false to stop.
    using MayDraw = std::function<bool(int frame, int last)>;

    /// `first`: the frame from which a scene with feedback is drawn. The buffers may hold anything.
    FrameStepper(Renderer& renderer, FrameStates states, int first = 0)
        : renderer_(renderer), states_(std::move(states)), first_(first) {}
    /// Draws frames of the run that `state` belongs to.
    FrameStepper(Renderer& renderer, const FrameState& state, int first = 0)
        : FrameStepper(
              renderer, [state](int frame) { return state.at_frame(frame); }, first) {}

    /// Draws a frame. Returns false while the frame is incomplete; it is then not counted and will be
    /// requested again.
    using DrawFrame = std::function<bool(const FrameInputs&)>;
    /// Replaces the renderer's whole-frame drawing.
    void draw_by(DrawFrame draw) { draw_frame_ = std::move(draw); }

    FrameSteps draw(int frame, const MayDraw& may_draw = {});
    /// Draws all that `draw` draws except the frame itself, so that the buffers hold that frame's inputs.
    FrameSteps lead_to(int frame, const MayDraw& may_draw = {});
    /// Declares that the renderer's buffers hold the inputs of that frame.
    void start_from(int frame) { next_ = frame; }
    /// Draws up to the pass within the frame. With feedback, the next request starts from the first frame
    /// again.
    PassPreview preview(int frame, size_t pass, const MayDraw& may_draw = {});

private:
    FrameSteps step(int end, int last, const MayDraw& may_draw);

    Renderer& renderer_;
    FrameStates states_;
    int first_;
    DrawFrame draw_frame_{};
    std::optional<int> next_{}; ///< frame whose inputs the buffers hold; none: unknown
};

} // namespace tidemark::render
