// Drawing a given frame: previews of a pass, and the steps up to a frame.
//
// A pass just before it is drawn, after all earlier passes of the frame: other programs can be drawn in its
// place.
#pragma once

#include "base/extent.hpp"
#include "render/frame_state.hpp"
#include "render/gl_program.hpp"
#include "render/gl_textures.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"
#include "shader/shader_source.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace tidemark::render {

/// While it lives, the buffers are within a frame, and its Renderer must not draw. With feedback, the
/// destructor clears the buffers, because a partly drawn frame cannot be continued.
class PassPreview {
public:
    /// Draws the passes of the frame before `pass`.
    PassPreview(Renderer& renderer, size_t pass, const FrameInputs& inputs);

    /// Returns a preview of the shown pass after the `draw` of those inputs. Draws nothing, and leaves the
    /// buffers as they are. Requires Renderer::can_draw_again.
    static PassPreview again(Renderer& renderer, const FrameInputs& inputs);

    const scene::Scene& scene() const { return renderer_->scene(); }
    const scene::Pass& pass() const { return scene().passes[pass_]; }
    /// The pass's own program, and the dialect that it was linked in.
    const gl::Program& program() const { return renderer_->program(pass_); }
    const glsl::Dialect& dialect() const { return renderer_->dialect(pass_); }
    /// Returns the size of the pass's picture.
    Extent extent() const;

    /// Draws with `program`, made from a text of the same dialect, into a target of any size, with the pass's
    /// uniforms and textures; one face of a cubemap. Does not draw the pass itself.
    void draw(const gl::Program& program, const gl::RenderTarget& into, int face = 0) const;

private:
    struct Reset {
        bool needed; ///< false: the buffers hold a whole frame
        void operator()(Renderer* renderer) const;
    };
    struct Again {};
    PassPreview(Again, Renderer& renderer, const FrameInputs& inputs);
    std::unique_ptr<Renderer, Reset> renderer_; ///< not owned
    size_t pass_;
    FrameInputs inputs_;
};

// Draws any frame of a run. If frames depend on the previous one, the frames that lead to it are drawn first;
// otherwise it jumps.

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
    std::optional<int> next_{}; ///< frame whose inputs the buffers hold; none: unknown
};

} // namespace tidemark::render
