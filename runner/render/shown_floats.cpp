#include "render/shown_floats.hpp"

#include "gl/scissor.hpp"

namespace tidemark::render {

const gl::Texture& ShownFloats::draw(const Renderer& renderer, const FrameInputs& inputs,
                                     const Rectangle& part) {
    const gl::Texture& shown = renderer.target().texture;
    if (shown.internal_format != GL_RGBA8 || !has_target(renderer))
        return shown;
    const gl::Scissor only(part);
    renderer.draw_again(inputs, *target_);
    return target_->texture;
}

/// Makes a target of the picture's size, so that gl_FragCoord stays the same.
bool ShownFloats::has_target(const Renderer& renderer) {
    if (!can_draw_again_)
        can_draw_again_ = renderer.can_draw_again();
    if (!*can_draw_again_)
        return false;
    if (!target_ || target_->extent() != renderer.extent())
        target_ = gl::make_render_target(gl::make_texture(renderer.extent(), GL_RGBA32F, 1));
    return target_.has_value();
}

} // namespace tidemark::render
