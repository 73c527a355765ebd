// What the shown pass wrote, as floats: a window keeps Image in bytes, so that a part of it is drawn again
// into floats when somebody wants to know. Draws nothing of the frame itself.
#pragma once

#include "base/rectangle.hpp"
#include "gl/render_target.hpp"
#include "render/renderer.hpp"

#include <optional>

namespace tidemark::render {

/// Of one renderer, in its context.
class ShownFloats {
public:
    /// A texture whose pixels within `part` are those of the frame on show, which `inputs` drew. Where the
    /// pass cannot be drawn again, or there is no memory, it is the picture of bytes itself.
    const gl::Texture& draw(const Renderer& renderer, const FrameInputs& inputs, const Rectangle& part);

private:
    bool has_target(const Renderer& renderer);

    std::optional<bool> can_draw_again_{}; ///< none: not asked yet
    std::optional<gl::RenderTarget> target_{};
};

} // namespace tidemark::render
