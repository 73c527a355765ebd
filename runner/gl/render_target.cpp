#include "gl/render_target.hpp"

#include <cassert>

namespace tidemark::gl {

std::optional<RenderTarget> make_render_target(Extent extent, GLenum internal_format) {
    while (glGetError() != GL_NO_ERROR) { // an older error is not about this target
    }
    RenderTarget target{make_texture(extent, internal_format, 1), {}};
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    target.framebuffer = FramebufferHandle(id);
    glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, target.texture.id(), 0);
    if (glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return std::nullopt;
    constexpr GLfloat k_zero[4] = {};
    glClearNamedFramebufferfv(id, GL_COLOR, 0, k_zero);
    if (glGetError() != GL_NO_ERROR)
        return std::nullopt;
    return target;
}

void read_pixels(const RenderTarget& target, GLenum format, GLenum type, std::span<std::byte> pixels) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    assert(pixels.size() >= target.extent().pixels());
    glReadPixels(0, 0, target.extent().width, target.extent().height, format, type, pixels.data());
}

void blit_to_window(const RenderTarget& target, Extent window) {
    const Extent from = target.extent();
    glBlitNamedFramebuffer(target.framebuffer.id(), 0, 0, 0, from.width, from.height, 0, 0, window.width,
                           window.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

} // namespace tidemark::gl
