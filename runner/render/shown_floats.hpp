// Redraws parts of the shown pass as floats on demand, because a window keeps Image in bytes. Draws no other
// pass.
#pragma once

#include "base/rectangle.hpp"
#include "gl/render_target.hpp"
#include "render/renderer.hpp"

#include <optional>

namespace tidemark::render {

/// Belongs to one renderer and its context.
class ShownFloats {
public:
    /// Returns a texture whose pixels within `part` are those of the frame on show, drawn from `inputs`. If
    /// the pass cannot be drawn again, or there is no memory, returns the picture in bytes.
    const gl::Texture& draw(const Renderer& renderer, const FrameInputs& inputs, const Rectangle& part);

private:
    bool has_target(const Renderer& renderer);

    std::optional<bool> can_draw_again_{}; ///< empty: not checked yet
    std::optional<gl::RenderTarget> target_{};
};

} // namespace tidemark::render
