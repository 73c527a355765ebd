// A pass just before it is drawn, after all earlier passes of the frame: other programs can be drawn in its
// place.
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

/// While it lives, the buffers are within a frame, and its Renderer must not draw. With feedback, the
/// destructor clears the buffers, because a partly drawn frame cannot be continued.
class PassPreview {
public:
    /// Draws the passes of the frame before `pass`.
    PassPreview(Renderer& renderer, size_t pass, const FrameInputs& inputs);

    const scene::Scene& scene() const;
    const scene::Pass& pass() const;
    /// The pass's own program, and the dialect that it was linked in.
    const gl::Program& program() const;
    const glsl::Dialect& dialect() const;
    /// Returns the size of the pass's picture.
    Extent extent() const;

    /// Draws with `program`, made from a text of the same dialect, into a target of any size, with the pass's
    /// uniforms and textures; one face of a cubemap. Does not draw the pass itself.
    void draw(const gl::Program& program, const gl::RenderTarget& into, int face = 0) const;

private:
    struct Reset {
        void operator()(Renderer* renderer) const;
    };
    std::unique_ptr<Renderer, Reset> renderer_; ///< not owned
    size_t pass_;
    FrameInputs inputs_;
};

} // namespace tidemark::render
