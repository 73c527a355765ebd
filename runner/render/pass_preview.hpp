// A pass that is about to be drawn, in a frame of which everything in front of it is drawn: other programs
// can draw what it would.
#pragma once

#include "base/extent.hpp"
#include "gl/program.hpp"
#include "gl/render_target.hpp"
#include "glsl/dialect.hpp"
#include "render/frame_inputs.hpp"
#include "scene/scene.hpp"

#include <memory>

namespace tidemark::render {

class Renderer;

/// Buffers have made half a step while it lives, and its Renderer draws no frame. Where there is feedback
/// they are zero when it goes: nothing can go on from half a step.
class PassPreview {
public:
    /// Goes on into the frame as far as `pass`.
    PassPreview(Renderer& renderer, size_t pass, const FrameInputs& inputs);

    const scene::Scene& scene() const;
    const scene::Pass& pass() const;
    /// The program of the pass itself, and what it was linked as.
    const gl::Program& program() const;
    const glsl::Dialect& dialect() const;
    /// The size of what the pass draws.
    Extent extent() const;

    /// Draws by `program`, made from a text of the same dialect, into a target of any size; uniforms and
    /// textures are the pass's. Of a cubemap, one face. The pass itself stays undrawn.
    void draw(const gl::Program& program, const gl::RenderTarget& into, int face = 0) const;

private:
    struct Reset {
        void operator()(Renderer* renderer) const;
    };
    std::unique_ptr<Renderer, Reset> renderer_; ///< somebody else's
    size_t pass_;
    FrameInputs inputs_;
};

} // namespace tidemark::render
